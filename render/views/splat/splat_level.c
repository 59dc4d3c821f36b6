#include "render/views/splat/splat_private.h"
#include "shaders/splat/splat_bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>

/* Distance between samples in radii, in the first round and in later rounds. The pieces have errors of
   1e-3 of the field, so that only tiny chords of the level are missed. SLACK: the largest error of a
   root's first guess. */
static const float APART = 0.375F, APART_BEHIND = 0.5F, SLACK = 0.1F;

float splat_level_range(const Frame *frame)
{
    return 4 * APART * frame->radii.drawn;
}

double splat_level_gain(double radius, double spacing, bool flat)
{
    const double n = spacing / radius;
    return flat ? 4 / M_PI * n * n : 315 / (64 * M_PI) * n * n * n;
}

float splat_level_gain_of(const Frame *frame, const ParticleBuffers *particles)
{
    return (float)splat_level_gain(frame->radii.drawn, particles->spacing, frame->slab > 0);
}

double splat_level_lone_distance(double level, double gain, double radius)
{
    return level < gain ? radius * sqrt(1 - cbrt(level / gain)) : 0;
}

static bool create_sprites(SplatLevel *level, const SplatSprites *sprites, SplatSprite sprite, Error *error)
{
    const bool listed = splat_culls(&sprites->def);
    unsigned *const programs[] = {&level->next[sprite], &level->sum[sprite], &level->single[sprite]};
    static const char *const files[] = {"splat/splat_level_next.frag", "splat/splat_level_sum.frag",
                                        "splat/splat_level_sum.frag"};
    for (int i = 0; i < 3; i++) {
        *programs[i] = splat_sprites_program(sprites, sprite, listed, files[i],
                                             i == 2 ? "#define SINGLE 1\n" : "", error);
        if (!*programs[i])
            return false;
    }
    return true;
}

static GLuint compile_screen(const char *file, const char *defines, Error *error)
{
    return program_create(file, (const char *const[]){"common/screen.vert", file, NULL}, defines, error);
}

bool splat_level_create(SplatLevel *level, SplatSprites *sprites, Error *error)
{
    *level = (SplatLevel){0};
    glCreateQueries(GL_ANY_SAMPLES_PASSED, SPLAT_LEVEL_ROUNDS, level->queries);
    for (int sprite = SPLAT_QUAD; sprite <= SPLAT_POINT; sprite++)
        if (splat_sprites_can_use(sprites, (SplatSprite)sprite) &&
            !create_sprites(level, sprites, (SplatSprite)sprite, error))
            return false;
    if (splat_culls(&sprites->def) && !splat_cull_create_limit(&sprites->cull, error))
        return false;
    level->open = compile_screen("splat/splat_level_open.frag", NULL, error);
    level->open_found =
        level->open ? compile_screen("splat/splat_level_open.frag", "#define FOUND 1\n", error) : 0;
    level->step = level->open_found ? compile_screen("splat/splat_level_step.frag", NULL, error) : 0;
    level->root = level->step ? compile_screen("splat/splat_level_root.frag", NULL, error) : 0;
    level->asking = level->root ? compile_screen("render/depth_only.frag", NULL, error) : 0;
    return level->asking != 0;
}

static void delete_maps(SplatLevel *level)
{
    glDeleteFramebuffers(4, (GLuint[]){level->march_framebuffer, level->sum_framebuffer,
                                       level->single_framebuffer, level->next_framebuffer});
    glDeleteTextures(3, (GLuint[]){level->march, level->value, level->slope});
}

void splat_level_destroy(SplatLevel *level)
{
    for (int sprite = 0; sprite <= SPLAT_POINT; sprite++) {
        glDeleteProgram(level->next[sprite]);
        glDeleteProgram(level->sum[sprite]);
        glDeleteProgram(level->single[sprite]);
    }
    glDeleteProgram(level->open);
    glDeleteProgram(level->open_found);
    glDeleteProgram(level->step);
    glDeleteProgram(level->root);
    glDeleteProgram(level->asking);
    glDeleteQueries(SPLAT_LEVEL_ROUNDS, level->queries);
    delete_maps(level);
    *level = (SplatLevel){0};
}

static GLuint with_limit(GLuint framebuffer, const SplatMaps *maps)
{
    glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, maps->limit, 0);
    return framebuffer;
}

static void follow(SplatLevel *level, const SplatMaps *maps, const Target *target)
{
    if (level->target_number == target->number)
        return;
    delete_maps(level);
    level->march = splat_map_create(GL_RGBA32F, target, "splat march");
    level->value = splat_map_create(GL_RGBA32F, target, "splat value");
    level->slope = splat_map_create(GL_RGBA32F, target, "splat slope");
    level->march_framebuffer =
        with_limit(splat_framebuffer_create((GLuint[]){level->march, maps->nearest}, 2, "splat march"), maps);
    level->sum_framebuffer =
        with_limit(splat_framebuffer_create((GLuint[]){level->value, level->slope}, 2, "splat sum"), maps);
    level->single_framebuffer = with_limit(splat_framebuffer_create(&level->value, 1, "splat value"), maps);
    level->next_framebuffer = with_limit(splat_framebuffer_create(&maps->nearest, 1, "splat next"), maps);
    level->target_number = target->number;
}

/* Inputs of all passes of one search. */
typedef struct LevelSearch {
    SplatLevel *level;
    SplatSprites *sprites;
    SplatSprite sprite;
    const ParticleBuffers *particles;
    const Frame *frame;
    const SplatMaps *maps;
    float target; /* the level divided by the gain */
} LevelSearch;

/* Runs over all pixels that particles may cover; the shader's depth becomes the limit. */
static void fill(const LevelSearch *search, GLuint program, GLuint framebuffer)
{
    glTextureBarrier(); /* some passes read and write the same texels */
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, search->frame->width, search->frame->height);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glDepthMask(GL_TRUE);
    glUseProgram(program);
    glBindVertexArray(search->sprites->screen);
    frame_set_scissor(search->frame);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
}

/* Draws all sprites in front of the limit. */
static void splat(const LevelSearch *search, GLuint program, GLuint framebuffer, GLenum equation)
{
    const SplatCullList list = CULL_BLEND;
    splat_sprites_begin(framebuffer, search->frame, equation);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_FALSE);
    counts_begin(search->frame->counts);
    splat_sprites_draw(search->sprites, search->sprite, program, search->particles, search->frame,
                       splat_culls(&search->sprites->def) ? &list : NULL);
    counts_end(search->frame->counts, STAGE_VISIBILITY);
}

/* Shaders must not read an attached texture here: some drivers keep attachments in another format until
   unbound. */
static void list_to_limit(const LevelSearch *search)
{
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    if (splat_culls(&search->sprites->def))
        splat_cull_to_limit(&search->sprites->cull, search->particles, search->frame, search->maps->limit,
                            search->sprite == SPLAT_POINT ? 1 : 6);
}

/* Asks if the limit lets anything through: draws a triangle at the near plane that only the depth test
   sees. */
static void ask(const LevelSearch *search, GLuint query)
{
    glBindFramebuffer(GL_FRAMEBUFFER, search->level->next_framebuffer);
    glViewport(0, 0, search->frame->width, search->frame->height);
    glDepthRange(1, 1);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_FALSE);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glUseProgram(search->level->asking);
    glBindVertexArray(search->sprites->screen);
    frame_set_scissor(search->frame);
    glBeginQuery(GL_ANY_SAMPLES_PASSED, query);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEndQuery(GL_ANY_SAMPLES_PASSED);
    glDisable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthRange(0, 1);
}

static void look(const LevelSearch *search, float apart)
{
    const SplatLevel *level = search->level;
    glProgramUniform1f(level->open, SEARCH_RANGE_AT, 4 * apart * search->frame->radii.drawn);
    fill(search, level->open, level->sum_framebuffer);
    glProgramUniform1f(level->sum[search->sprite], APART_AT, apart);
    splat(search, level->sum[search->sprite], level->sum_framebuffer, GL_FUNC_ADD);
    glProgramUniform1f(level->step, APART_AT, apart);
    glProgramUniform1f(level->step, APART_NEXT_AT, APART_BEHIND);
    glProgramUniform1f(level->step, LEVEL_AT, search->target);
    fill(search, level->step, level->march_framebuffer);
}

/* Skipped if the last round left no pixel to search; later rounds are then skipped too. */
static void look_again(const LevelSearch *search, int round)
{
    SplatLevel *level = search->level;
    if (round > 1)
        glBeginConditionalRender(level->queries[round - 1], GL_QUERY_WAIT);
    ask(search, level->queries[round]);
    if (round > 1)
        glEndConditionalRender();
    glBeginConditionalRender(level->queries[round], GL_QUERY_WAIT);
    list_to_limit(search);
    splat(search, level->next[search->sprite], level->next_framebuffer, GL_MIN);
    look(search, APART_BEHIND);
    glEndConditionalRender();
}

static void refine(const LevelSearch *search)
{
    const SplatLevel *level = search->level;
    glProgramUniform1f(level->open_found, SEARCH_RANGE_AT, SLACK * search->frame->radii.drawn);
    fill(search, level->open_found, level->single_framebuffer);
    list_to_limit(search);
    splat(search, level->single[search->sprite], level->single_framebuffer, GL_FUNC_ADD);
    glProgramUniform1f(level->root, SLACK_AT, SLACK);
    glProgramUniform1f(level->root, LEVEL_AT, search->target);
    fill(search, level->root, search->maps->nearest_framebuffer);
}

void splat_level_find(SplatLevel *level, const SplatMaps *maps, SplatSprites *sprites, SplatSprite sprite,
                      const ParticleBuffers *particles, const Frame *frame)
{
    const float gain = splat_level_gain_of(frame, particles);
    const LevelSearch search = {
        level, sprites, sprite, particles, frame, maps, (float)splat_def(frame->def)->level / gain};
    follow(level, maps, frame->target);
    glDepthMask(GL_TRUE); /* clearing obeys the depth mask */
    glClearNamedFramebufferfv(level->march_framebuffer, GL_COLOR, 0, (GLfloat[4]){0});
    glClearNamedFramebufferfv(level->march_framebuffer, GL_DEPTH, 0, (GLfloat[]){1});
    glBindTextureUnit(NEAREST_UNIT, maps->nearest);
    glBindTextureUnit(MARCH_UNIT, level->march);
    glBindTextures(VALUE_UNIT, 2, (GLuint[]){level->value, level->slope});
    look(&search, APART);
    for (int round = 1; round < SPLAT_LEVEL_ROUNDS; round++)
        look_again(&search, round);
    refine(&search);
}

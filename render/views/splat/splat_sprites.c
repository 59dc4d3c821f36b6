#include "render/particles/particles.h"
#include "render/views/splat/splat_private.h"
#include "shaders/shared/bindings.h"
#include "shaders/splat/splat_bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>

bool fluid_tiles_create(FluidTiles *tiles, Error *error)
{
    static const char *const stages[] = {"splat/tiles_list.comp", NULL};
    *tiles = (FluidTiles){0};
    glCreateVertexArrays(1, &tiles->none);
    work_buffer_remake(&tiles->command, 4 * sizeof(GLuint), "tiles command");
    tiles->list = program_create("tiles list", stages, NULL, error);
    return tiles->list != 0;
}

void fluid_tiles_destroy(FluidTiles *tiles)
{
    glDeleteProgram(tiles->list);
    glDeleteVertexArrays(1, &tiles->none);
    glDeleteBuffers(3, (GLuint[]){tiles->marks, tiles->rects, tiles->command});
    *tiles = (FluidTiles){0};
}

void fluid_tiles_update(FluidTiles *tiles, const Target *target)
{
    static const GLuint marked = 1;
    if (tiles->target_number == target->number)
        return;
    const size_t columns = ((size_t)target->width + TILE - 1) / TILE,
                 rows = ((size_t)target->height + TILE - 1) / TILE;
    work_buffer_remake(&tiles->marks, columns * rows * sizeof(GLuint), "tiles marks");
    work_buffer_remake(&tiles->rects, (columns + 1) / 2 * rows * 4 * sizeof(GLuint), "tiles rects");
    glClearNamedBufferData(tiles->marks, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &marked);
    tiles->target_number = target->number;
}

void fluid_tiles_list(const FluidTiles *tiles, const Frame *frame, bool all)
{
    GLint bounds[4] = {0};
    if (all)
        frame_bounds(frame, bounds);
    glUseProgram(tiles->list);
    glUniform4iv(TILES_BOUNDS_AT, 1, bounds);
    glUniform2ui(TILES_PICTURE_AT, (GLuint)frame->width, (GLuint)frame->height);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, TILE_MARKS_STORAGE, tiles->marks);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, TILE_RECTS_STORAGE, tiles->rects);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, TILE_COMMAND_STORAGE, tiles->command);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    work_run(1);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT);
}

void fluid_tiles_draw(const FluidTiles *tiles)
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, TILE_RECTS_STORAGE, tiles->rects);
    glBindVertexArray(tiles->none);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, tiles->command);
    glDrawArraysIndirect(GL_TRIANGLES, NULL);
}

enum { CHUNK = 32, COMMAND_SIZE = 32, CELLS_A_SIDE = 1024 };

/* A coarse map: see shaders/splat/cull.glsl. */
typedef struct CullGrid {
    GLuint columns, rows, side;
    GLfloat width, height; /* pixels */
} CullGrid;

static GLuint compile_cull(const char *label, const char *file, const char *defines, Error *error)
{
    return program_create(label, (const char *const[]){file, NULL}, defines, error);
}

/* `body`: defines of splat/splat_body.glsl for the particles' shape. Returns false if a shader does not
   compile; call splat_cull_destroy in either case. */
static bool splat_cull_create(SplatCull *cull, const char *body, Error *error)
{
    *cull = (SplatCull){0};
    work_buffer_remake(&cull->commands, (size_t)CULL_LISTS * COMMAND_SIZE, "cull commands");
    cull->occlude = compile_cull("cull occlude", "splat/cull_occlude.comp", body, error);
    cull->test = cull->occlude ? compile_cull("cull test", "splat/cull_test.comp", body, error) : 0;
    cull->list = cull->test && prefix_sums_create(&cull->sums, error)
                     ? compile_cull("cull list", "splat/cull_list.comp", NULL, error)
                     : 0;
    return cull->list != 0;
}

bool splat_cull_create_limit(SplatCull *cull, Error *error)
{
    cull->limit = compile_cull("cull limit", "splat/cull_limit.comp", NULL, error);
    return cull->limit != 0;
}

static void splat_cull_destroy(SplatCull *cull)
{
    glDeleteProgram(cull->occlude);
    glDeleteProgram(cull->test);
    glDeleteProgram(cull->list);
    glDeleteProgram(cull->limit);
    glDeleteTextures(1, &cull->rows);
    glDeleteBuffers(CULL_LISTS, cull->lists);
    glDeleteBuffers(3, (GLuint[]){cull->map, cull->kept, cull->commands});
    prefix_sums_destroy(&cull->sums);
    *cull = (SplatCull){0};
}

static GLuint chunks_of(size_t count)
{
    return (GLuint)((count + CHUNK - 1) / CHUNK);
}

/* Rounded up to whole texels of `rows`. */
static size_t cells_of(const CullGrid *grid)
{
    return (size_t)(grid->columns + 3) / 4 * 4 * grid->rows;
}

static void reserve_lists(SplatCull *cull, size_t count, size_t cells)
{
    if (cells > cull->cells) {
        cull->cells = work_capacity(cull->cells, cells) / 4 * 4;
        work_buffer_remake(&cull->map, cull->cells * sizeof(GLuint), "cull map");
        glDeleteTextures(1, &cull->rows);
        glCreateTextures(GL_TEXTURE_BUFFER, 1, &cull->rows);
        glTextureBuffer(cull->rows, GL_RGBA32UI, cull->map);
    }
    if (count > cull->capacity) {
        cull->capacity = work_capacity(cull->capacity, count);
        work_buffer_remake(&cull->kept, (4 * (size_t)chunks_of(cull->capacity) + 1) * sizeof(GLuint),
                           "cull kept");
        for (int i = 0; i < CULL_LISTS; i++)
            work_buffer_remake(&cull->lists[i], cull->capacity * sizeof(GLuint), "cull list");
    }
}

static GLuint clamp_to(double value, double low, double high)
{
    return (GLuint)fmax(low, fmin(value, high)); /* `low` for NaN */
}

/* The largest cells such that the smallest sprite, `least` pixels wide inside its rim, always covers a
   whole cell: needs side + (side - 1) pixels. */
static CullGrid make_grid(double width, double height, double least)
{
    const double coarse = ceil(fmax(width, height) / CELLS_A_SIDE);
    const GLuint side = clamp_to(floor((least + 1) / 2), coarse, 4096);
    return (CullGrid){.columns = (GLuint)ceil(width / side),
                      .rows = (GLuint)ceil(height / side),
                      .side = side,
                      .width = (GLfloat)width,
                      .height = (GLfloat)height};
}

static void use_cull_program(GLuint program, const CullGrid *grid, const ParticleBuffers *particles,
                             const Frame *frame)
{
    glUseProgram(program);
    if (particles)
        particle_bind(program, particles, view_color_by(frame->def));
    glUniform2ui(CELLS_AT, grid->columns, grid->rows);
    glUniform1ui(CELL_SIDE_AT, grid->side);
    glUniform2f(CULL_PIXELS_AT, grid->width, grid->height);
}

static void make_map(SplatCull *cull, const CullGrid *grid, const ParticleBuffers *particles,
                     const Frame *frame)
{
    static const GLfloat nothing = INFINITY;
    const size_t cells = cells_of(grid);
    reserve_lists(cull, particles->count, cells);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                    GL_TEXTURE_FETCH_BARRIER_BIT);
    glClearNamedBufferSubData(cull->map, GL_R32F, 0, (GLsizeiptr)(cells * sizeof nothing), GL_RED, GL_FLOAT,
                              &nothing);
    use_cull_program(cull->occlude, grid, particles, frame);
    glUniform1ui(CULL_COUNT_AT, (GLuint)particles->count);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, CULL_MAP_STORAGE, cull->map);
    glBindTextureUnit(CULL_ROWS_UNIT, cull->rows);
    work_run_scattered(particles->count);
}

static void make_lists(SplatCull *cull, size_t count, unsigned vertices)
{
    prefix_sums_run(&cull->sums, cull->kept, 2 * (size_t)chunks_of(count) + 1);
    glUseProgram(cull->list);
    glUniform1ui(CHUNKS_AT, chunks_of(count));
    glUniform1ui(VERTICES_AT, vertices);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, CULL_COMMANDS_STORAGE, cull->commands);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, NEAREST_LIST_STORAGE, CULL_LISTS, cull->lists);
    work_run(chunks_of(count));
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT);
}

static void test(SplatCull *cull, const CullGrid *grid, const ParticleBuffers *particles, const Frame *frame,
                 float eps, unsigned vertices, bool hidden)
{
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    use_cull_program(cull->test, grid, particles, frame);
    glBindTextureUnit(CULL_ROWS_UNIT, cull->rows);
    glUniform1ui(CULL_COUNT_AT, (GLuint)particles->count);
    glUniform1f(EPS_AT, eps);
    glUniform1ui(INVERT_AT, hidden);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, CULL_KEPT_STORAGE, cull->kept);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, TILE_MARKS_STORAGE, cull->marks);
    work_run(chunks_of(particles->count));
    make_lists(cull, particles->count, vertices);
}

static void make_for_grid(SplatCull *cull, const CullGrid *grid, const ParticleBuffers *particles,
                          const Frame *frame, float eps, unsigned vertices, bool hidden)
{
    make_map(cull, grid, particles, frame);
    test(cull, grid, particles, frame, eps, vertices, hidden);
}

/* Diameter in pixels of a sphere at `distance` in the middle of the picture. */
static double pixels_across(const Frame *frame, double distance)
{
    return frame->radii.drawn / fmax(distance, frame->camera.near_plane) / frame->camera.tangent[1] *
           frame->height;
}

static CullGrid eye_grid(const Frame *frame)
{
    return make_grid(frame->width, frame->height, pixels_across(frame, frame->extent.farthest) * sqrt(0.5));
}

void splat_cull_for_eye(SplatCull *cull, const ParticleBuffers *particles, const Frame *frame, float eps,
                        unsigned vertices, bool hidden)
{
    const CullGrid grid = eye_grid(frame);
    if (particles->count > 0)
        make_for_grid(cull, &grid, particles, frame, eps, vertices, hidden);
}

void splat_cull_to_limit(SplatCull *cull, const ParticleBuffers *particles, const Frame *frame,
                         unsigned limit, unsigned vertices)
{
    const CullGrid grid = eye_grid(frame);
    if (particles->count == 0)
        return;
    reserve_lists(cull, particles->count, cells_of(&grid));
    use_cull_program(cull->limit, &grid, NULL, NULL);
    glBindTextureUnit(LIMIT_UNIT, limit);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, CULL_MAP_STORAGE, cull->map);
    work_run((size_t)grid.columns * grid.rows);
    test(cull, &grid, particles, frame, 0, vertices, false);
}

/* Binds a list for shaders with LISTED. Returns the offset in cull->commands of the drawing command. */
static size_t splat_cull_bind(const SplatCull *cull, SplatCullList list)
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LISTED_STORAGE, cull->lists[list]);
    return (size_t)list * COMMAND_SIZE;
}

bool splat_sprites_create(SplatSprites *sprites, const SplatDef *def, Error *error)
{
    *sprites = (SplatSprites){.def = *def, .point_sprite_limit = point_sprite_limit()};
    glCreateVertexArrays(1, &sprites->screen);
    quad_indices_create(&sprites->quads);
    char body[96];
    snprintf(body, sizeof body, "%s%s", ellipsoids_defines(def),
             silhouette_by_discs(def) ? "#define DISCS 1\n" : "");
    return fluid_tiles_create(&sprites->tiles, error) &&
           (!splat_culls(def) || splat_cull_create(&sprites->cull, body, error));
}

void splat_sprites_destroy(SplatSprites *sprites)
{
    glDeleteVertexArrays(1, &sprites->screen);
    quad_indices_destroy(&sprites->quads);
    splat_cull_destroy(&sprites->cull);
    fluid_tiles_destroy(&sprites->tiles);
}

bool splat_sprites_can_use(const SplatSprites *sprites, SplatSprite sprite)
{
    return sprites->def.sprite == sprite ||
           (sprites->def.sprite == SPLAT_AUTO && (sprite == SPLAT_QUAD || sprites->point_sprite_limit > 0));
}

/* An upper bound of the largest sphere's diameter in pixels, at the rim of the picture. */
SplatSprite splat_sprites_choose(const SplatSprites *sprites, const Frame *frame, float radius, float height)
{
    const float *tangent = frame->camera.tangent, slant = 1 + camera_max_slant_squared(&frame->camera);
    if (sprites->def.sprite != SPLAT_AUTO)
        return sprites->def.sprite;
    if (sprites->point_sprite_limit <= 0 || frame->extent.nearest <= radius)
        return SPLAT_QUAD;
    const float across = radius / frame->extent.nearest * slant / tangent[1] * height + 1;
    return across < sprites->point_sprite_limit ? SPLAT_POINT : SPLAT_QUAD;
}

bool splat_sprites_small(const Frame *frame)
{
    const float pixels = 0.5F * (float)frame->height / frame->camera.tangent[1]; /* pixels of 1 m at a
                                                                                    distance of 1 m */
    const double spacings = frame->def->radius > 0 ? frame->def->radius : 1;
    const double drop =
        splat_def(frame->def)->drops ? fmin(0.56 / spacings, 1) : 1; /* a disc; a ball is larger */
    const ScalarCurve *size = &frame->def->size;
    const double most = fmax(control_points_most(&size->curve), 1e-30);
    const double least = size->by != 0 ? control_points_least(&size->curve) / most : 1;
    return least * drop * frame->radii.drawn * pixels < 0.8F * frame->extent.farthest;
}

unsigned splat_sprites_program(const SplatSprites *sprites, SplatSprite sprite, bool listed,
                               const char *fragment, const char *defines, Error *error)
{
    const char *const stages[] = {"splat/splat.vert", fragment, NULL};
    char all[256];
    snprintf(all, sizeof all, "%s%s%s%s", ellipsoids_defines(&sprites->def),
             sprite == SPLAT_POINT ? "#define POINT 1\n" : "", listed ? "#define LISTED 1\n" : "", defines);
    return program_create(fragment, stages, all, error);
}

static void bind_sprites(unsigned program, const ParticleBuffers *particles, const Frame *frame)
{
    glUseProgram(program);
    particle_bind(program, particles, view_color_by(frame->def));
}

/* Draws a point per particle with any program, except programs of splat/splat.vert: for these use
   splat_sprites_draw. */
static void splat_sprites_draw_points(SplatSprites *sprites, unsigned program,
                                      const ParticleBuffers *particles, const Frame *frame,
                                      const SplatCullList *list)
{
    const size_t command = list ? splat_cull_bind(&sprites->cull, *list) : 0;
    bind_sprites(program, particles, frame);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glBindVertexArray(sprites->screen);
    if (particles->count == 0)
        return;
    if (!list) {
        glDrawArrays(GL_POINTS, 0, (GLsizei)particles->count);
        return;
    }
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, sprites->cull.commands);
    glDrawArraysIndirect(GL_POINTS, (const char *)NULL + command);
}

static void draw_quads(SplatSprites *sprites, unsigned program, const ParticleBuffers *particles,
                       const Frame *frame, const SplatCullList *list)
{
    const size_t command = list ? splat_cull_bind(&sprites->cull, *list) : 0;
    bind_sprites(program, particles, frame);
    if (list)
        quad_indices_draw_indirect(&sprites->quads, particles->count, sprites->cull.commands, command);
    else
        quad_indices_draw(&sprites->quads, particles->count);
}

void splat_sprites_draw(SplatSprites *sprites, SplatSprite sprite, unsigned program,
                        const ParticleBuffers *particles, const Frame *frame, const SplatCullList *list)
{
    if (sprite == SPLAT_POINT)
        splat_sprites_draw_points(sprites, program, particles, frame, list);
    else
        draw_quads(sprites, program, particles, frame, list);
}

void splat_sprites_draw_listed(SplatSprites *sprites, SplatSprite sprite, unsigned program,
                               const ParticleBuffers *particles, const Frame *frame, unsigned command)
{
    bind_sprites(program, particles, frame);
    if (particles->count == 0)
        return;
    if (sprite == SPLAT_QUAD) {
        quad_indices_draw_indirect(&sprites->quads, particles->count, command, 0);
        return;
    }
    glEnable(GL_PROGRAM_POINT_SIZE);
    glBindVertexArray(sprites->screen);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, command);
    glDrawArraysIndirect(GL_POINTS, NULL);
}

void splat_sprites_begin(unsigned framebuffer, const Frame *frame, unsigned equation)
{
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(equation);
    glBlendFunc(GL_ONE, GL_ONE);
}

/* The edges of the box, and what lies over a view: blends colour and tests depth; writes depth if
   Frame.depths. */
#include "render/frame/effect.h"
#include "render/frame/view.h"
#include "shaders/shared/bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdint.h>

enum { EDGE_COUNT = 12 };

static GLuint create_indices(void)
{
    static const uint16_t corners[6] = {0, 1, 2, 2, 1, 3};
    uint16_t index[6 * EDGE_COUNT];
    GLuint buffer;
    for (int i = 0; i < 6 * EDGE_COUNT; i++)
        index[i] = (uint16_t)(4 * (i / 6) + corners[i % 6]);
    glCreateBuffers(1, &buffer);
    glObjectLabel(GL_BUFFER, buffer, -1, "edge indices");
    glNamedBufferStorage(buffer, sizeof index, index, 0);
    return buffer;
}

bool box_edges_create(BoxEdges *edges, Error *error)
{
    glCreateVertexArrays(1, &edges->vertex_array);
    edges->indices = create_indices();
    glVertexArrayElementBuffer(edges->vertex_array, edges->indices);
    edges->program = program_create_pair("edges", "render/edges.vert", "render/edges.frag", error);
    return edges->program != 0;
}

void box_edges_destroy(BoxEdges *edges)
{
    glDeleteProgram(edges->program);
    glDeleteVertexArrays(1, &edges->vertex_array);
    glDeleteBuffers(1, &edges->indices);
    *edges = (BoxEdges){0};
}

static void draw_edges(const BoxEdges *edges, GLuint program, const Frame *frame, bool behind)
{
    const float fine = frame->fineness,
                part = (float)frame->height / 720; /* 1 for a picture 720 pixels high */
    const float width = frame_glass(frame) ? fmaxf(2 * fine, 3 * part) : fmaxf(1.5F * fine, 1.5F * part);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, behind ? GL_ONE : GL_ZERO,
                        behind ? GL_ONE_MINUS_SRC_ALPHA : GL_ONE);
    glUseProgram(program);
    glProgramUniform1f(program, HALF_WIDTH_AT, width / 2);
    glProgramUniform1ui(program, EDGES_BEHIND_AT, behind);
    glBindVertexArray(edges->vertex_array);
    glDrawElements(GL_TRIANGLES, 6 * EDGE_COUNT, GL_UNSIGNED_SHORT, NULL);
    glDisable(GL_BLEND);
}

static void begin_edges(const Frame *frame, GLuint framebuffer)
{
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
    glDepthMask(frame->depths);
}

static void box_edges_draw(const BoxEdges *edges, const Frame *frame)
{
    begin_edges(frame, frame->target->framebuffer);
    draw_edges(edges, edges->program, frame, false);
}

/* Draws the edges seen only through the box: between two sides that face away from the eye. */
static void box_edges_draw_far(const BoxEdges *edges, const Frame *frame, unsigned framebuffer)
{
    begin_edges(frame, framebuffer);
    draw_edges(edges, edges->program, frame, true);
}

static GLuint create_copy(GLenum format, const Target *target, GLint filter, const char *label)
{
    GLuint copy;
    glCreateTextures(GL_TEXTURE_2D, 1, &copy);
    glObjectLabel(GL_TEXTURE, copy, -1, label);
    glTextureStorage2D(copy, 1, format, target->width, target->height);
    glTextureParameteri(copy, GL_TEXTURE_MIN_FILTER, filter);
    glTextureParameteri(copy, GL_TEXTURE_MAG_FILTER, filter);
    glTextureParameteri(copy, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(copy, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return copy;
}

void background_copy_destroy(BackgroundCopy *background)
{
    glDeleteTextures(2, (GLuint[]){background->color, background->depth});
    glDeleteFramebuffers(1, &background->framebuffer);
    *background = (BackgroundCopy){0};
}

static void update_copy(BackgroundCopy *background, const Frame *frame)
{
    const bool solids = frame->world->solid_count > 0;
    if (background->target_number == frame->target->number && solids == (background->depth != 0))
        return;
    background_copy_destroy(background);
    background->color = create_copy(GL_SRGB8_ALPHA8, frame->target, GL_LINEAR, "behind");
    if (solids)
        background->depth = create_copy(GL_DEPTH_COMPONENT32F, frame->target, GL_NEAREST, "behind, depth");
    glCreateFramebuffers(1, &background->framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, background->framebuffer, -1, "behind");
    glNamedFramebufferTexture(background->framebuffer, GL_COLOR_ATTACHMENT0, background->color, 0);
    glNamedFramebufferTexture(background->framebuffer, GL_DEPTH_ATTACHMENT, frame->target->depth, 0);
    background->target_number = frame->target->number;
}

static void copy(GLuint from, GLuint to, const Frame *frame)
{
    glCopyImageSubData(from, GL_TEXTURE_2D, 0, 0, 0, 0, to, GL_TEXTURE_2D, 0, 0, 0, 0, frame->width,
                       frame->height, 1);
}

static void draw_far_edges(const BackgroundCopy *background, const BoxEdges *edges, const Frame *frame)
{
    if (!edges || !frame->def->box || frame->flat)
        return;
    glViewport(0, 0, frame->width, frame->height);
    box_edges_draw_far(edges, frame, background->framebuffer);
}

void background_copy_make_edges(BackgroundCopy *background, const BoxEdges *edges, const Frame *frame)
{
    static const float nothing[4] = {0};
    update_copy(background, frame);
    glClearNamedFramebufferfv(background->framebuffer, GL_COLOR, 0, nothing);
    draw_far_edges(background, edges, frame);
    glBindTextureUnit(BEHIND_COLOR_UNIT, background->color);
    glBindTextureUnit(FLOOR_LIGHT_UNIT, frame->floor.light);
}

void background_copy_make(BackgroundCopy *background, const BoxEdges *edges, const Frame *frame)
{
    update_copy(background, frame);
    copy(frame->target->color, background->color, frame);
    if (background->depth)
        copy(frame->target->depth, background->depth, frame);
    draw_far_edges(background, edges, frame);
    glBindTextureUnit(BEHIND_COLOR_UNIT, background->color);
    glBindTextureUnit(BEHIND_DEPTH_UNIT, background->depth);
    glBindTextureUnit(FLOOR_LIGHT_UNIT, frame->floor.light);
}

static void depth_destroy(void *state)
{
    OverlayDepth *over = state;
    glDeleteFramebuffers(1, &over->framebuffer);
    glDeleteTextures(1, &over->depth);
    *over = (OverlayDepth){0};
}

static bool update_depth(OverlayDepth *over, const Target *target)
{
    if (over->framebuffer && over->width == target->width && over->height == target->height)
        return true;
    depth_destroy(over);
    over->width = target->width;
    over->height = target->height;
    glCreateTextures(GL_TEXTURE_2D, 1, &over->depth);
    gl_debug_errors(); /* drops earlier errors: the query below is for this texture */
    glTextureStorage2D(over->depth, 1, GL_DEPTH_COMPONENT32F, over->width, over->height);
    if (gl_errors_take(0) > 0) {
        depth_destroy(over);
        return false;
    }
    glTextureParameteri(over->depth, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(over->depth, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glObjectLabel(GL_TEXTURE, over->depth, -1, "depth over the view");
    glCreateFramebuffers(1, &over->framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, over->framebuffer, -1, "depth over the view");
    glNamedFramebufferTexture(over->framebuffer, GL_DEPTH_ATTACHMENT, over->depth, 0);
    glNamedFramebufferDrawBuffer(over->framebuffer, GL_NONE);
    return true;
}

/* Copies the target's present depths; `to`: a target without colour, for the overlays' and edges' depths.
   Returns false if the driver has no memory. */
static bool begin_depth(OverlayDepth *over, const Target *target, Target *to)
{
    const int width = target->width, height = target->height;
    if (!update_depth(over, target))
        return false;
    glCopyImageSubData(target->depth, GL_TEXTURE_2D, 0, 0, 0, 0, over->depth, GL_TEXTURE_2D, 0, 0, 0, 0,
                       width, height, 1);
    *to = (Target){.width = width,
                   .height = height,
                   .number = target->number,
                   .framebuffer = over->framebuffer,
                   .depth = over->depth};
    return true;
}

/* ---- the effects ---- */

static bool edges_prepare(void *state, const Subject *subject, Error *error)
{
    const BoxEdges *edges = state;
    (void)subject;
    return edges->program || box_edges_create(state, error);
}

static void edges_destroy(void *state)
{
    box_edges_destroy(state);
}

static const EffectState edges_state = {
    .size = sizeof(BoxEdges), .prepare = edges_prepare, .destroy = edges_destroy};

static bool edges_within_wanted(const Picture *picture)
{
    return picture_has_front(picture) && picture_has_edges(picture);
}

static void draw_edges_within(void *state, Picture *picture)
{
    box_edges_draw(state, &picture->frame);
}

const Effect effect_edges_within = {.name = "edges_within",
                                    .stage = STAGE_OVERLAY,
                                    .state = &edges_state,
                                    .wanted = edges_within_wanted,
                                    .draw = draw_edges_within};

static bool edges_wanted(const Picture *picture)
{
    return picture_has_edges(picture) && !picture_has_front(picture);
}

/* Draws into the full resolution, whose colours are encoded, hidden by the depth of the coarse picture. */
static void draw_edges_upscaled(const BoxEdges *edges, const Upscale *coarse, const Frame *frame)
{
    glBindTextureUnit(COARSE_DEPTH_UNIT, coarse->target.depth);
    glDisable(GL_DEPTH_TEST);
    draw_edges(edges, coarse->edges, frame, false);
}

static void draw_edges_over(void *state, Picture *picture)
{
    if (picture->coarse)
        draw_edges_upscaled(state, picture->coarse, &picture->frame);
    else
        box_edges_draw(state, &picture->frame);
}

const Effect effect_edges = {.name = "edges",
                             .stage = STAGE_OVERLAY,
                             .state = &edges_state,
                             .wanted = edges_wanted,
                             .draw = draw_edges_over};

static const EffectState depth_state = {.size = sizeof(OverlayDepth), .destroy = depth_destroy};

static bool depth_wanted(const Picture *picture)
{
    return picture_has_front(picture) &&
           (picture_has_edges(picture) || overlays_wanted(picture->overlays, &picture->frame));
}

static void draw_depth(void *state, Picture *picture)
{
    OverlayDepth *over = state;
    Frame depths = picture->frame;
    Target target;
    picture->frame.over = over;
    if (!begin_depth(over, depths.target, &target))
        return;
    const bool overlays = overlays_wanted(picture->overlays, &depths);
    depths.target = &target;
    depths.depths = true;
    if (overlays)
        overlays_draw(picture->overlays, picture->particles, &depths);
    if (picture_has_edges(picture))
        GL_STAGE(depths.timer, STAGE_OVERLAY)
        {
            box_edges_draw(effect_state(picture->states, &edges_state), &depths);
        }
    over->coarse = overlays && overlays_unfinished(picture->overlays);
}

const Effect effect_overlay_depth = {.name = "overlay_depth",
                                     .stage = STAGE_COUNT,
                                     .state = &depth_state,
                                     .wanted = depth_wanted,
                                     .draw = draw_depth};

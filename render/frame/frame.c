#include "render/frame/frame.h"

#include "shaders/shared/frame_block.h"
#include "shaders/shared/shadow_maps.h"

#include <epoxy/gl.h>
#include <math.h>
#include <string.h>

static GLuint create_texture(GLenum format, int width, int height, const char *label)
{
    GLuint texture;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, width, height);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glObjectLabel(GL_TEXTURE, texture, -1, label);
    return texture;
}

bool target_create(Target *target, int width, int height, Error *error)
{
    static unsigned targets;
    GLint limit = 0;
    *target = (Target){.width = width, .height = height, .number = ++targets};
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (width < 1 || height < 1 || width > limit || height > limit)
        return error_set(error, "a picture of %d x %d pixels cannot be drawn; 1 to %d a side can", width,
                         height, limit);
    target->color = create_texture(GL_SRGB8_ALPHA8, width, height, "target color");
    target->depth = create_texture(GL_DEPTH_COMPONENT32F, width, height, "target depth");
    glCreateFramebuffers(1, &target->framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, target->framebuffer, -1, "target");
    glNamedFramebufferTexture(target->framebuffer, GL_COLOR_ATTACHMENT0, target->color, 0);
    glNamedFramebufferTexture(target->framebuffer, GL_DEPTH_ATTACHMENT, target->depth, 0);
    if (glCheckNamedFramebufferStatus(target->framebuffer, GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE)
        return true;
    target_destroy(target);
    return error_set(error, "the driver does not take a framebuffer of %d x %d pixels; try a smaller one",
                     width, height);
}

void target_destroy(Target *target)
{
    glDeleteFramebuffers(1, &target->framebuffer);
    glDeleteTextures(1, &target->color);
    glDeleteTextures(1, &target->depth);
    *target = (Target){0};
}

void target_begin(const Target *target)
{
    static const float far_depth = 0;
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    glViewport(0, 0, target->width, target->height);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDisable(GL_SCISSOR_TEST);
    glClearNamedFramebufferfv(target->framebuffer, GL_DEPTH, 0, &far_depth);
}

static void flip_rows(uint8_t *rgb, size_t row, size_t height)
{
    for (size_t y = 0; y < height / 2; y++) {
        uint8_t *top = rgb + y * row, *bottom = rgb + (height - 1 - y) * row;
        for (size_t i = 0; i < row; i++) {
            uint8_t keep = top[i];
            top[i] = bottom[i];
            bottom[i] = keep;
        }
    }
}

void target_read(const Target *target, uint8_t *rgb)
{
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target->framebuffer);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, target->width, target->height, GL_RGB, GL_UNSIGNED_BYTE, rgb);
    flip_rows(rgb, 3 * (size_t)target->width, (size_t)target->height);
}

void target_present(const Target *target, int x, int y)
{
    glDisable(GL_FRAMEBUFFER_SRGB); /* colours are encoded already */
    glDisable(GL_SCISSOR_TEST);
    glBlitNamedFramebuffer(target->framebuffer, 0, 0, 0, target->width, target->height, x, y,
                           x + target->width, y + target->height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(x, y, target->width, target->height);
}

void target_read_depth(const Target *target, float *depth)
{
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target->framebuffer);
    glReadPixels(0, 0, target->width, target->height, GL_DEPTH_COMPONENT, GL_FLOAT, depth);
}

void counts_begin(ViewCounts *counts)
{
    if (!counts)
        return;
    glCreateQueries(GL_SAMPLES_PASSED, 1, &counts->query);
    glBeginQuery(GL_SAMPLES_PASSED, counts->query);
}

void counts_end(ViewCounts *counts, Stage stage)
{
    GLuint64 samples = 0;
    if (!counts)
        return;
    glEndQuery(GL_SAMPLES_PASSED);
    glGetQueryObjectui64v(counts->query, GL_QUERY_RESULT, &samples);
    glDeleteQueries(1, &counts->query);
    counts->fragments[stage] += (double)samples;
}

void counts_finish(ViewCounts *counts, uint64_t covered, uint64_t pixels)
{
    counts->counted = true;
    counts->coverage = (double)covered / (double)pixels;
    for (int stage = 0; stage < STAGE_COUNT; stage++)
        counts->fragments[stage] /= covered > 0 ? (double)covered : 1;
}

_Static_assert(FRAME_FLUIDS_MAX == FLUIDS_MAX, "shaders have a colour for each fluid");

/* Softness of shadows on the floor, in sides of the shadow map. */
static const float LIGHT_RADIUS = 0.035F;

/* The def's range, or the range found in this state; never empty. */
static void range_of(const ScalarRange *found, bool automatic, bool symmetric, const double said[2],
                     double range[2])
{
    const double reach = fmax(fabs(found->low), fabs(found->high));
    range[0] = !automatic ? said[0] : symmetric ? -reach : found->low;
    range[1] = !automatic ? said[1] : symmetric ? reach : found->high;
    const double least = 1e-6 * fmax(fabs(range[0]), 1e-6); /* all values equal: any width is fine */
    if (!(range[1] - range[0] > least))
        range[1] = range[0] + fmax(1e-3 * fabs(range[0]), 1e-3);
}

static void curve_range(const ScalarCurve *curve, const ParticleBuffers *particles, double range[2])
{
    range[0] = range[1] = 0;
    if (curve->by != 0)
        range_of(&particles->range[scalar_of_curve(curve)], curve->range_auto, curve->range_symmetric,
                 curve->range, range);
}

static void make_ranges(Frame *frame, const ParticleBuffers *particles)
{
    const ViewDef *def = frame->def;
    const ScalarRange *found = &particles->range[view_color_by(def)];
    range_of(found, def->range_auto, def->range_symmetric, def->range, frame->colors.range);
    frame->colors.beyond[0] = def->range_auto && found->least < frame->colors.range[0];
    frame->colors.beyond[1] = def->range_auto && found->greatest > frame->colors.range[1];
    curve_range(&def->opacity, particles, frame->curves.opacity);
    curve_range(&def->size, particles, frame->curves.size);
    frame->colors.name = scalar_name(view_color_by(def));
    frame->colors.unit = scalar_unit(view_color_by(def));
}

/* The light comes from the left, the front and above the automatic camera. The shadow map covers the ball
   around the box. */
static void make_light(Frame *frame, const double size[3], const float center[3])
{
    static const float to_light[3] = {-0.40F, 0.84F, 0.3666F};
    static const float side[3] = {0.9029F, 0.4299F, 0}, up[3] = {-0.1576F, 0.3310F, -0.9304F};
    const float *axes[3] = {side, up, to_light};
    double diagonal = sqrt(size[0] * size[0] + size[1] * size[1] + size[2] * size[2]);
    memcpy(frame->light.to, to_light, sizeof to_light);
    frame->light.depth = (float)(1.1 * diagonal);
    memset(frame->light.from_world, 0, sizeof frame->light.from_world);
    frame->light.from_world[15] = 1;
    for (int row = 0; row < 3; row++) {
        float middle = 0;
        for (int k = 0; k < 3; k++) {
            frame->light.from_world[4 * k + row] = axes[row][k] / frame->light.depth;
            middle += axes[row][k] * center[k];
        }
        frame->light.from_world[12 + row] = 0.5F - middle / frame->light.depth;
    }
}

/* Widens low .. high to hold the shadow of a ball on the floor; world frame. */
static void add_shadow(const Frame *frame, const float at[3], float radius, float low[2], float high[2])
{
    const float drop = (at[1] - frame->floor.height) / frame->light.to[1], wide = radius / frame->light.to[1];
    for (int k = 0; k < 2; k++) {
        low[k] = fminf(low[k], at[2 * k] - drop * frame->light.to[2 * k] - wide);
        high[k] = fmaxf(high[k], at[2 * k] - drop * frame->light.to[2 * k] + wide);
    }
}

/* Solids may leave the box; solids outside the light's map cast no shadow. */
static void add_solids(const Frame *frame, double time, float low[2], float high[2])
{
    for (int i = 0; i < frame->world->solid_count; i++) {
        BoxState pose;
        float at[3], in_light[3];
        solid_pose_in(&frame->world->solids[i], time, &frame->floating[i], &pose);
        for (int k = 0; k < 3; k++)
            at[k] = (float)pose.position[k];
        matrix_transform(frame->box_to_world, at, at);
        matrix_transform(frame->light.from_world, at, in_light);
        if (fabsf(in_light[0] - 0.5F) < 0.5F && fabsf(in_light[1] - 0.5F) < 0.5F)
            add_shadow(frame, at, (float)solid_reach(&frame->world->solids[i]), low, high);
    }
}

/* The area where light rays through the box's corners meet the floor, with a margin for soft shadow rims. */
static void make_floor_map(Frame *frame, const double size[3], double time)
{
    float low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int corner = 0; corner < 8; corner++) {
        float at[3] = {(float)size[0] * ((corner & 1) ? 0.5F : -0.5F), (corner & 2) ? (float)size[1] : 0,
                       (float)size[2] * ((corner & 4) ? 0.5F : -0.5F)};
        matrix_transform(frame->box_to_world, at, at);
        add_shadow(frame, at, 0, low, high);
    }
    add_solids(frame, time, low, high);
    float margin = 1.5F * (LIGHT_RADIUS * frame->light.depth + frame->radii.drawn);
    for (int k = 0; k < 2; k++) {
        frame->floor.map_corner[k] = low[k] - margin;
        frame->floor.map_size[k] = high[k] - low[k] + 2 * margin;
    }
}

/* The floor stands still while the box moves, like the automatic camera. */
static void make_floor(Frame *frame, const double size[3], const BoxState *box, double time)
{
    double diagonal = sqrt(size[0] * size[0] + size[1] * size[1] + size[2] * size[2]);
    float anchor[3];
    camera_anchor(size, box, anchor);
    /* A gap, so that the box casts a visible shadow; in two dimensions the box stands on the floor. */
    frame->floor.height = (float)((frame->slab > 0 ? -0.001 : -0.045) * diagonal);
    frame->floor.center[0] = anchor[0];
    frame->floor.center[1] = anchor[2];
    frame->floor.radius = frame->def->floor ? (float)(4.0 * diagonal) : 0;
    make_floor_map(frame, size, time);
}

/* The bounds of the box widened by particle_reach: contains a cube around each sphere. */
static void make_bounds(Frame *frame, const double size[3])
{
    const float r = frame->radii.reach, *tangent = frame->camera.tangent, *centre = frame->camera.centre;
    float box_to_eye[16], low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    matrix_multiply(frame->camera.view, frame->box_to_world, box_to_eye);
    frame->extent.nearest = INFINITY;
    frame->extent.farthest = -INFINITY;
    for (int corner = 0; corner < 8; corner++) {
        float at[3] = {((corner & 1) ? 1.0F : -1.0F) * ((float)size[0] / 2 + r),
                       (corner & 2) ? (float)size[1] + r : -r,
                       ((corner & 4) ? 1.0F : -1.0F) * ((float)size[2] / 2 + r)};
        matrix_transform(box_to_eye, at, at);
        frame->extent.nearest = fminf(frame->extent.nearest, -at[2]);
        frame->extent.farthest = fmaxf(frame->extent.farthest, -at[2]);
        for (int k = 0; k < 2; k++) {
            low[k] = fminf(low[k], at[k] / (-at[2] * tangent[k]) + centre[k]);
            high[k] = fmaxf(high[k], at[k] / (-at[2] * tangent[k]) + centre[k]);
        }
    }
    bool before = frame->extent.nearest > frame->camera.near_plane;
    for (int k = 0; k < 2; k++) {
        frame->extent.bounds[2 * k] = before ? fmaxf(-1, fminf(low[k], 1)) : -1;
        frame->extent.bounds[2 * k + 1] = before ? fmaxf(-1, fminf(high[k], 1)) : 1;
    }
    frame->extent.all_in_view = before && low[0] > -1 && low[1] > -1 && high[0] < 1 && high[1] < 1;
}

double frame_slab_depth(const ParticleBuffers *particles)
{
    const double depth = particles->box_size[2];
    return fabs(depth - particles->spacing) < 1e-6 * depth ? depth : 0;
}

/* Two fifths of the longest side; in two dimensions the depth of the one layer, since light passes no more
   fluid. */
static float usual_attenuation(const double size[3], double slab)
{
    return (float)(slab > 0 ? slab : fmax(size[0], fmax(size[1], size[2])) * 0.4);
}

void frame_make(Frame *frame, const Subject *subject, const ParticleBuffers *particles, const Target *target,
                ParticleRadii radii, CoveredParts covered)
{
    const ViewDef *def = subject->def;
    *frame = (Frame){.width = target->width,
                     .height = target->height,
                     .fineness = 1,
                     .def = def,
                     .world = subject->world,
                     .floating = particles->floating,
                     .target = target,
                     .radii = radii};
    const ViewDef seen = camera_at(def, particles->time);
    camera_make(&seen, particles->box_size, &particles->box, (double)target->width / target->height, covered,
                &frame->camera);
    camera_box_matrix(&particles->box, frame->box_to_world);
    float middle[3] = {0, (float)particles->box_size[1] / 2, 0}, center[3];
    matrix_transform(frame->box_to_world, middle, center);
    make_light(frame, particles->box_size, center);
    frame->slab = frame_slab_depth(particles);
    frame->fluid.attenuation = usual_attenuation(particles->box_size, frame->slab);
    make_bounds(frame, particles->box_size);
    make_floor(frame, particles->box_size, &particles->box, particles->time);
    make_ranges(frame, particles);
    frame->colors.fluids_known = particles->fluid.buffer != 0;
    frame->colors.by_fluid =
        view_color_by(def) == SCALAR_FLUID || !particles->scalar[view_color_by(def)].buffer;
}

/* With `auto`, a picture without a clear fluid surface (an intermediate stage of the view) has lines. */
FrameGlass frame_glass(const Frame *frame)
{
    const ViewDef *def = frame->def;
    const bool glass = view_has_glass(def) && !frame->flat && !(frame->slab > 0) &&
                       (def->walls == VIEW_WALLS_GLASS || frame->fluid.clear > 0);
    return !glass ? GLASS_NONE : def->drawn_quality == VIEW_DRAFT ? GLASS_EDGES : GLASS_PANES;
}

void frame_bounds(const Frame *frame, int part[4])
{
    const float size[2] = {(float)frame->width, (float)frame->height};
    for (int k = 0; k < 2; k++) {
        part[k] = (int)floorf((0.5F + 0.5F * frame->extent.bounds[2 * k]) * size[k]);
        part[2 + k] = (int)ceilf((0.5F + 0.5F * frame->extent.bounds[2 * k + 1]) * size[k]);
    }
}

void frame_set_scissor(const Frame *frame)
{
    int part[4];
    frame_bounds(frame, part);
    glEnable(GL_SCISSOR_TEST);
    glScissor(part[0], part[1], part[2] - part[0], part[3] - part[1]);
}

unsigned frame_uniforms_create(void)
{
    GLuint buffer;
    glCreateBuffers(1, &buffer);
    glObjectLabel(GL_BUFFER, buffer, -1, "frame uniforms");
    glNamedBufferStorage(buffer, sizeof(FrameBlock), NULL, GL_DYNAMIC_STORAGE_BIT);
    return buffer;
}

static void set2(float out[2], double x, double y)
{
    out[0] = (float)x, out[1] = (float)y;
}

static void set3(float out[3], double x, double y, double z)
{
    out[0] = (float)x, out[1] = (float)y, out[2] = (float)z;
}

static void set4(float out[4], double x, double y, double z, double w)
{
    set3(out, x, y, z);
    out[3] = (float)w;
}

static void rotate(const float matrix[16], const float v[3], float out[3])
{
    for (int row = 0; row < 3; row++)
        out[row] = matrix[row] * v[0] + matrix[4 + row] * v[1] + matrix[8 + row] * v[2];
}

static void fill_matrices(FrameBlock *block, const Frame *frame)
{
    matrix_multiply(frame->camera.view, frame->box_to_world, block->box_to_eye);
    matrix_multiply(frame->light.from_world, frame->box_to_world, block->box_to_light);
    memcpy(block->world_to_light, frame->light.from_world, sizeof block->world_to_light);
    matrix_invert_rigid(frame->camera.view, block->eye_to_world);
    matrix_multiply(frame->light.from_world, block->eye_to_world, block->eye_to_light);
}

/* Linear light: a white key light, a sky with some of the background's tint, warm light reflected from the
   floor. */
static void fill_colors(FrameBlock *block, const Frame *frame)
{
    const double *back = frame->def->background;
    double bright = 0.2126 * back[0] + 0.7152 * back[1] + 0.0722 * back[2];
    double ink = bright > 0.18 ? 0.03 : 0.75; /* edges contrast with the background */
    set3(block->background, back[0], back[1], back[2]);
    set3(block->light_color, 0.98, 0.94, 0.88);
    set3(block->sky_color, 0.46 + 0.10 * back[0], 0.50 + 0.10 * back[1], 0.54 + 0.12 * back[2]);
    set3(block->ground_color, 0.20 + 0.06 * back[0], 0.19 + 0.06 * back[1], 0.18 + 0.06 * back[2]);
    set4(block->edge_color, ink, ink, ink, 0.85);
    for (int i = 0; i < FLUIDS_MAX; i++) {
        bool known = i < frame->world->fluid_count;
        const float *color = frame->world->fluids[i].color;
        set4(block->fluid_color[i], known ? color[0] : 0.1, known ? color[1] : 0.35, known ? color[2] : 0.7,
             1);
    }
}

static void fill_view(FrameBlock *block, const Frame *frame)
{
    const Camera *camera = &frame->camera;
    set2(block->view_tangent, camera->tangent[0], camera->tangent[1]);
    set2(block->view_centre, camera->centre[0], camera->centre[1]);
    block->near_plane = camera->near_plane;
    block->fineness = frame->fineness;
    set2(block->picture_size, frame->width, frame->height);
    set2(block->pixel_size, 1.0 / frame->width, 1.0 / frame->height);
}

static void fill_light(FrameBlock *block, const Frame *frame)
{
    static const float up[3] = {0, 1, 0};
    block->light_depth = frame->light.depth;
    block->light_radius = LIGHT_RADIUS;
    block->shading = frame->plain ? 0 : 1;
    rotate(frame->camera.view, frame->light.to, block->light_in_eye);
    memcpy(block->light_in_world, frame->light.to, sizeof block->light_in_world);
    block->shadow_spread = frame->fineness == FINEST_RESOLUTION ? 1.5F / SHADOW_MAP_TEXELS : 0;
    rotate(frame->camera.view, up, block->up_in_eye);
}

static void fill_floor(FrameBlock *block, const Frame *frame)
{
    block->floor_height = frame->floor.height;
    block->floor_radius = frame->floor.radius;
    memcpy(block->floor_center, frame->floor.center, sizeof block->floor_center);
    memcpy(block->floor_map_corner, frame->floor.map_corner, sizeof block->floor_map_corner);
    memcpy(block->floor_map_size, frame->floor.map_size, sizeof block->floor_map_size);
}

static void fill_particles(FrameBlock *block, const Frame *frame, const double box_size[3], double spacing)
{
    set3(block->box_size, box_size[0], box_size[1], box_size[2]);
    block->particle_radius = frame->radii.drawn;
    block->particle_spacing = (float)spacing;
    block->shadow_radius = frame->radii.shadow;
    block->range_low = (float)frame->colors.range[0];
    block->range_scale = (float)(1 / (frame->colors.range[1] - frame->colors.range[0]));
    block->by_fluid = frame->colors.by_fluid;
    block->fluid_clear = frame->fluid.clear;
    block->glass = (uint32_t)frame_glass(frame);
    for (unsigned k = 0; k < 3; k++) /* no front and back walls in two dimensions */
        if (!frame->world->periodic[k] && !(k == 2 && frame->slab > 0))
            block->walled |= 1U << k;
}

void frame_uniforms_update(unsigned buffer, const Frame *frame, const double box_size[3], double spacing)
{
    FrameBlock block = {0};
    fill_matrices(&block, frame);
    fill_colors(&block, frame);
    fill_view(&block, frame);
    fill_light(&block, frame);
    fill_floor(&block, frame);
    fill_particles(&block, frame, box_size, spacing);
    glNamedBufferSubData(buffer, 0, sizeof block, &block);
    glBindBufferBase(GL_UNIFORM_BUFFER, FRAME_BLOCK, buffer);
}

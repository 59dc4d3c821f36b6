#include "render/frame/frame.h"
#include "render/frame/passes.h"
#include "render/frame/view.h"
#include "render/views/volume/volume_private.h"
#include "shaders/shared/bindings.h"
#include "shaders/volume/raycast_block.h"
#include "shaders/volume/volume_bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

VolumeOpacity volume_opacity(const ViewDef *def)
{
    const VolumeDef *own = volume_def(def);
    if (def->opacity.by == 0 || own->raycast.look != RAYCAST_TRANSLUCENT || own->show != VOLUME_SHADED)
        return VOLUME_EVEN;
    return scalar_of_curve(&def->opacity) == view_color_by(def) && view_color_by(def) != SCALAR_FLUID
               ? VOLUME_BY_COLOR
               : VOLUME_BY_OWN;
}

VolumeSurface volume_surface(const ViewDef *def)
{
    const VolumeDef *own = volume_def(def);
    return own->raycast.look == RAYCAST_TRANSLUCENT || own->show == VOLUME_SLICE ? VOLUME_RAYS : own->surface;
}

bool volume_is_tinted(const Subject *subject)
{
    const VolumeDef *def = volume_def(subject->def);
    return def->show == VOLUME_SHADED && view_color_by(subject->def) == SCALAR_FLUID &&
           subject->world->fluid_count > 2 && def->method != VOLUME_DIRECT;
}

/* The transfer function of translucent fluid as a table for shaders/volume/raycast_gather.glsl. By
   position on the field's ramp: the curve, its integral from 0 on, and its total rise and fall; by
   position in the scalar's range: the opacity. With integrals, a piece of a ray between two samples is
   exact for any curve. After: Engel, Kraus, Ertl, High-quality pre-integrated volume rendering, 2001, in
   one dimension, for a field that is linear between samples. */
enum { TRANSFER_ENTRIES = 256 };

/* The table as a texture, RGBA32F, linear. */
typedef struct Transfer {
    unsigned texture; /* 0: not created yet */
    ControlPoints curve, opacity;
} Transfer;

/* Four floats per entry, at x = i / (TRANSFER_ENTRIES - 1). Below 0 the curve is 0: a first value above 0
   counts as a rise at 0. */
static void transfer_fill(const ControlPoints *curve, const ControlPoints *opacity,
                          float table[4 * TRANSFER_ENTRIES])
{
    enum { PARTS = 64 };
    const double dx = 1.0 / (TRANSFER_ENTRIES - 1) / PARTS;
    double value = control_points_at(curve, 0), sum = 0, gone = fabs(value);
    for (int i = 0; i < TRANSFER_ENTRIES; i++) {
        for (int part = 0; i > 0 && part < PARTS; part++) {
            const double next = control_points_at(curve, ((i - 1) * PARTS + part + 1) * dx);
            sum += 0.5 * (value + next) * dx;
            gone += fabs(next - value);
            value = next;
        }
        table[4 * i] = (float)value;
        table[4 * i + 1] = (float)sum;
        table[4 * i + 2] = (float)gone;
        table[4 * i + 3] = (float)control_points_at(opacity, (double)i / (TRANSFER_ENTRIES - 1));
    }
}

static void transfer_destroy(Transfer *transfer)
{
    glDeleteTextures(1, &transfer->texture);
    *transfer = (Transfer){.texture = 0};
}

static void create_table(Transfer *transfer)
{
    glCreateTextures(GL_TEXTURE_2D, 1, &transfer->texture);
    glObjectLabel(GL_TEXTURE, transfer->texture, -1, "transfer function");
    glTextureStorage2D(transfer->texture, 1, GL_RGBA32F, TRANSFER_ENTRIES, 1);
    glTextureParameteri(transfer->texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(transfer->texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(transfer->texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
}

/* Makes the table for both curves, if different, and binds the texture (TRANSFER_UNIT). */
static void transfer_bind(Transfer *transfer, const ControlPoints *curve, const ControlPoints *opacity)
{
    const bool made = transfer->texture != 0;
    if (!made)
        create_table(transfer);
    if (!made || !control_points_equal(curve, &transfer->curve) ||
        !control_points_equal(opacity, &transfer->opacity)) {
        float table[4 * TRANSFER_ENTRIES];
        transfer_fill(curve, opacity, table);
        glTextureSubImage2D(transfer->texture, 0, 0, 0, TRANSFER_ENTRIES, 1, GL_RGBA, GL_FLOAT, table);
        transfer->curve = *curve;
        transfer->opacity = *opacity;
    }
    glBindTextureUnit(TRANSFER_UNIT, transfer->texture);
}

/* Finds the bricks of a volume that may hold fluid to draw, and the faces between these bricks and all
   others: rays enter and leave there and skip the empty rest.

   A brick stores the largest value of the field inside, by linear interpolation: over its voxels and the
   voxels that it shares with neighbours at its faces. After: Krüger and Westermann, Acceleration
   techniques for GPU-based volume rendering, 2003 (empty-space skipping). */
typedef struct Bricks {
    unsigned greatest, list, faces; /* programs */
    unsigned map;                   /* GL_TEXTURE_3D, R32F, a texel per brick */
    unsigned found, commands;       /* buffers: the faces; a drawing command */
    QuadIndices quads;
    int size[3];     /* bricks */
    size_t capacity; /* faces */
} Bricks;

/* Returns false if a shader does not compile; call bricks_destroy in either case. */
static bool bricks_create(Bricks *bricks, Error *error)
{
    *bricks = (Bricks){0};
    quad_indices_create(&bricks->quads);
    glCreateBuffers(1, &bricks->commands);
    glObjectLabel(GL_BUFFER, bricks->commands, -1, "brick commands");
    glNamedBufferStorage(bricks->commands, 5 * sizeof(GLuint), NULL, GL_DYNAMIC_STORAGE_BIT);
    bricks->greatest = program_create(
        "bricks greatest", (const char *const[]){"volume/bricks_greatest.comp", NULL}, NULL, error);
    if (bricks->greatest)
        bricks->list = program_create("bricks list", (const char *const[]){"volume/bricks_list.comp", NULL},
                                      NULL, error);
    if (bricks->list)
        bricks->faces =
            program_create_pair("bricks faces", "volume/bricks_faces.vert", "render/depth_only.frag", error);
    return bricks->faces != 0;
}

static void bricks_destroy(Bricks *bricks)
{
    glDeleteProgram(bricks->greatest);
    glDeleteProgram(bricks->list);
    glDeleteProgram(bricks->faces);
    glDeleteTextures(1, &bricks->map);
    glDeleteBuffers(2, (GLuint[]){bricks->found, bricks->commands});
    quad_indices_destroy(&bricks->quads);
    *bricks = (Bricks){0};
}

/* n voxels have n - 1 intervals between. */
int bricks_count(const VolumeGrid *grid, int count[3])
{
    int longest = 0;
    for (int k = 0; k < 3; k++)
        longest = grid->size[k] > longest ? grid->size[k] : longest;
    const int side = BRICK_CELLS * ((longest - 1) / (BRICK_CELLS * BRICKS_ALONG) + 1);
    for (int k = 0; k < 3; k++)
        count[k] = grid->size[k] > side ? (grid->size[k] - 2) / side + 1 : 1;
    return side;
}

/* Neighbours share faces: at most one face per pair of bricks. */
static size_t most_faces(const int size[3])
{
    const size_t x = (size_t)size[0], y = (size_t)size[1], z = (size_t)size[2];
    return (x + 1) * y * z + x * (y + 1) * z + x * y * (z + 1);
}

static void update_size(Bricks *bricks, const VolumeGrid *grid)
{
    int size[3];
    bricks_count(grid, size);
    if (bricks->map && size[0] == bricks->size[0] && size[1] == bricks->size[1] && size[2] == bricks->size[2])
        return;
    glDeleteTextures(1, &bricks->map);
    glCreateTextures(GL_TEXTURE_3D, 1, &bricks->map);
    glObjectLabel(GL_TEXTURE, bricks->map, -1, "bricks");
    glTextureStorage3D(bricks->map, 1, GL_R32F, size[0], size[1], size[2]);
    glTextureParameteri(bricks->map, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(bricks->map, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    for (int k = 0; k < 3; k++)
        bricks->size[k] = size[k];
    if (most_faces(size) <= bricks->capacity)
        return;
    bricks->capacity = most_faces(size);
    glDeleteBuffers(1, &bricks->found);
    glCreateBuffers(1, &bricks->found);
    glObjectLabel(GL_BUFFER, bricks->found, -1, "brick faces");
    glNamedBufferStorage(bricks->found, (GLsizeiptr)(bricks->capacity * sizeof(GLuint)), NULL, 0);
}

/* One invocation per brick: at most BRICKS_ALONG^3. */
static void dispatch_bricks(const Bricks *bricks)
{
    glDispatchCompute(((GLuint)(bricks->size[0] * bricks->size[1] * bricks->size[2]) + 63) / 64, 1, 1);
}

/* Without a volume (field summed at the sample), every brick may hold fluid. */
static void fill_map(const Bricks *bricks, const Volume *volume)
{
    static const GLfloat much = 1e30F;
    if (!volume->field) {
        glClearTexImage(bricks->map, 0, GL_RED, GL_FLOAT, &much);
        return;
    }
    glBindImageTexture(GREATEST_IMAGE, bricks->map, 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_R32F);
    glUseProgram(bricks->greatest);
    dispatch_bricks(bricks);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

/* Fills the map from the volume, and lists the faces of bricks above the threshold in the uniform block of
   shaders/volume/raycast.glsl. Bind this block first, and the field to texture unit 8. */
static void bricks_make(Bricks *bricks, const Volume *volume)
{
    static const GLuint none[5] = {0, 1, 0, 0, 0};
    update_size(bricks, &volume->grid);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    fill_map(bricks, volume);
    glNamedBufferSubData(bricks->commands, 0, sizeof none, none);
    glBindTextureUnit(GREATEST_UNIT, bricks->map);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, FACES_STORAGE, bricks->found);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, FACES_COMMAND_STORAGE, bricks->commands);
    glUseProgram(bricks->list);
    dispatch_bricks(bricks);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

/* Draws the faces, depth only; counter-clockwise seen from outside. */
static void bricks_draw_faces(Bricks *bricks)
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, FACES_STORAGE, bricks->found);
    glUseProgram(bricks->faces);
    quad_indices_draw_indirect(&bricks->quads, bricks->capacity, bricks->commands, 0);
}

/* Particles that the level surface leaves out: where the field stays below the level, particles are drawn
   as balls of their own volume. Reads the volume's field, the particles and the background; writes the
   target's colour and depth. */
typedef struct VolumeDrops {
    unsigned program;
    ColorTable colors;
    QuadIndices quads;
} VolumeDrops;

/* `defines`: lines of SOLIDS and WATER, as in raycasting. */
static bool volume_drops_create(VolumeDrops *drops, const ViewDef *def, const char *defines, Error *error)
{
    static const char *const stages[] = {"volume/drops.vert", "volume/drops.frag", NULL};
    quad_indices_create(&drops->quads);
    if (color_table_create(&drops->colors, view_colormap(def), &def->color_curve, error))
        drops->program = program_create("volume drops", stages, defines, error);
    return drops->program != 0;
}

/* a zeroed struct is allowed */
static void volume_drops_destroy(VolumeDrops *drops)
{
    glDeleteProgram(drops->program);
    color_table_destroy(&drops->colors);
    quad_indices_destroy(&drops->quads);
    *drops = (VolumeDrops){0};
}

/* The blocks of volume and raycasting must be bound; for water also the background. */
static void volume_drops_draw(VolumeDrops *drops, const ParticleBuffers *particles, const Frame *frame)
{
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    color_table_bind(&drops->colors, &frame->def->color_curve);
    glUseProgram(drops->program);
    particle_bind(drops->program, particles, view_color_by(frame->def));
    glUniform1i(DROPS_FLAT_AT, frame->slab > 0);
    quad_indices_draw(&drops->quads, particles->count);
    glDisable(GL_DEPTH_TEST);
}

/* GATE: a copy of ENTRY or EXIT, so that the depth test selects the pixels with rays before the shader
   runs. */
enum { ENTRY, EXIT, GATE, DEPTHS };
enum { FACES_IN, FACES_OUT, MARCH, FRAMEBUFFERS };

/* The longest step, in support radii: see step_from in shaders/volume/raycast_ray.glsl. */
static const double FAR_STEP = 0.5;

struct Raycast {
    GLuint program, settle; /* march; write depth */
    GLuint block, screen;
    ColorTable colors;
    Transfer transfer; /* if curve or opacity by a scalar needs a table */
    Bricks bricks;
    BackgroundCopy background; /* for water: */
    BoxEdges edges;
    GLuint depths[DEPTHS], framebuffers[FRAMEBUFFERS];
    SurfaceMesh mesh;       /* zero without a mesh */
    GLuint facets;          /* of a mesh's triangles: normal and edge, RGBA16F; 0: none */
    GLuint found;           /* distance of each ray's hit along the eye's axis, m, R32F; 0: no hit */
    unsigned target_number; /* number of the target that gave the textures their size; 0: none */
    VolumeDrops drops;      /* for surfaces of a volume, else zero */
    RaycastLook look;
    VolumeSurface surface;
    bool solids;
};

void raycast_destroy(Raycast *raycast)
{
    if (!raycast)
        return;
    volume_drops_destroy(&raycast->drops);
    bricks_destroy(&raycast->bricks);
    surface_mesh_destroy(&raycast->mesh);
    background_copy_destroy(&raycast->background);
    box_edges_destroy(&raycast->edges);
    glDeleteProgram(raycast->program);
    glDeleteProgram(raycast->settle);
    glDeleteBuffers(1, &raycast->block);
    glDeleteTextures(DEPTHS, raycast->depths);
    color_table_destroy(&raycast->colors);
    transfer_destroy(&raycast->transfer);
    glDeleteTextures(2, (GLuint[]){raycast->found, raycast->facets});
    glDeleteFramebuffers(FRAMEBUFFERS, raycast->framebuffers);
    glDeleteVertexArrays(1, &raycast->screen);
    free(raycast);
}

/* Defines for translucent fluid, in lines. */
static const char *translucent_defines(const ViewDef *def, char text[96])
{
    const VolumeOpacity opacity = volume_opacity(def);
    char by[32] = "";
    if (opacity != VOLUME_EVEN)
        snprintf(by, sizeof by, "#define OPACITY %d\n", (int)opacity);
    snprintf(text, 96, "#define TRANSLUCENT 1\n%s%s", raycast_is_curved(def) ? "#define CURVED 1\n" : "", by);
    return text;
}

/* Compiles exactly the program parts that the def needs. */
static GLuint create_program(const Subject *subject, const char *field, Error *error)
{
    static const char *const stages[] = {"common/screen.vert", "volume/raycast.frag", NULL};
    const RaycastDef *cast = &volume_def(subject->def)->raycast;
    static const int shows[] = {
        [VOLUME_ENTRY] = 1, [VOLUME_EXIT] = 2, [VOLUME_LENGTH] = 3, [VOLUME_STEPS] = 4, [VOLUME_NORMALS] = 5};
    static const char *const surfaces[] = {"", "#define MESH 1\n", "#define MESH 1\n#define FACETS 1\n"};
    char defines[360], translucent[96];
    snprintf(defines, sizeof defines, "#define SHOW %d\n%s%s%s%s%s%s%s",
             shows[volume_def(subject->def)->show],
             subject->world->solid_count > 0 ? "#define SOLIDS 1\n" : "", field,
             cast->look == RAYCAST_TRANSLUCENT ? translucent_defines(subject->def, translucent) : "",
             surfaces[volume_surface(subject->def)], cast->shadows ? "#define SHADOWS 1\n" : "",
             volume_is_tinted(subject) ? "#define TINTED 1\n" : "",
             cast->look != RAYCAST_WATER     ? ""
             : raycast_is_full(subject->def) ? "#define WATER 1\n#define FLOOR_SHADOW 1\n#define WHOLE 1\n"
                                             : "#define WATER 1\n#define FLOOR_SHADOW 1\n");
    return program_create("raycast", stages, defines, error);
}

/* Creates the drops if the picture shows a surface in a volume. */
static bool create_drops(Raycast *raycast, const Subject *subject, const Voxelizer *voxelizer, Error *error)
{
    const VolumeDef *def = volume_def(subject->def);
    char defines[64];
    if (!voxelizer || def->method == VOLUME_DIRECT || def->show != VOLUME_SHADED ||
        raycast->look == RAYCAST_TRANSLUCENT)
        return true;
    snprintf(defines, sizeof defines, "%s%s", raycast->solids ? "#define SOLIDS 1\n" : "",
             raycast->look == RAYCAST_WATER ? "#define WATER 1\n#define FLOOR_SHADOW 1\n" : "");
    return volume_drops_create(&raycast->drops, subject->def, defines, error);
}

bool raycast_is_full(const ViewDef *def)
{
    return def->drawn_quality != VIEW_DRAFT;
}

bool raycast_is_curved(const ViewDef *def)
{
    const RaycastDef *cast = &volume_def(def)->raycast;
    return cast->look == RAYCAST_TRANSLUCENT && !control_points_are_straight(&cast->curve);
}

Raycast *raycast_create(const Subject *subject, const Voxelizer *voxelizer, Error *error)
{
    const ViewDef *def = subject->def;
    Raycast *raycast = calloc(1, sizeof *raycast);
    if (!raycast) {
        error_set(error, "out of memory for raycasting");
        return NULL;
    }
    raycast->solids = subject->world->solid_count > 0;
    raycast->look = volume_def(def)->raycast.look;
    raycast->surface = volume_surface(def);
    glCreateVertexArrays(1, &raycast->screen);
    glCreateBuffers(1, &raycast->block);
    glObjectLabel(GL_BUFFER, raycast->block, -1, "raycast uniforms");
    glNamedBufferStorage(raycast->block, sizeof(RaycastBlock), NULL, GL_DYNAMIC_STORAGE_BIT);
    if (color_table_create(&raycast->colors, view_colormap(def), &def->color_curve, error))
        raycast->program = create_program(subject, voxelizer ? voxelizer_defines(voxelizer) : "", error);
    if (raycast->program)
        raycast->settle =
            program_create_pair("raycast depth", "common/screen.vert", "volume/raycast_depth.frag", error);
    if (raycast->settle && (raycast->look != RAYCAST_WATER || box_edges_create(&raycast->edges, error)) &&
        bricks_create(&raycast->bricks, error) &&
        (raycast->surface == VOLUME_RAYS ||
         surface_mesh_create(&raycast->mesh, raycast->surface == VOLUME_FACETS, error)) &&
        create_drops(raycast, subject, voxelizer, error))
        return raycast;
    raycast_destroy(raycast);
    return NULL;
}

static GLuint create_map(const Target *target, GLenum format, const char *label)
{
    GLuint texture;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glObjectLabel(GL_TEXTURE, texture, -1, label);
    glTextureStorage2D(texture, 1, format, target->width, target->height);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

static void attach_maps(Raycast *raycast, int framebuffer, int depth, const char *label)
{
    const GLuint name = raycast->framebuffers[framebuffer];
    glObjectLabel(GL_FRAMEBUFFER, name, -1, label);
    glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, raycast->depths[depth], 0);
    glNamedFramebufferDrawBuffer(name, GL_NONE);
}

static void follow_target(Raycast *raycast, const Target *target)
{
    static const char *const labels[DEPTHS] = {"ray entry", "ray exit", "ray gate"};
    static const GLenum both[2] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    if (raycast->target_number == target->number)
        return;
    glDeleteTextures(DEPTHS, raycast->depths);
    glDeleteTextures(2, (GLuint[]){raycast->found, raycast->facets});
    glDeleteFramebuffers(FRAMEBUFFERS, raycast->framebuffers);
    memset(raycast->depths, 0, sizeof raycast->depths);
    for (int i = 0; i < DEPTHS; i++)
        raycast->depths[i] = create_map(target, GL_DEPTH_COMPONENT32F, labels[i]);
    raycast->found = create_map(target, GL_R32F, "ray found");
    glCreateFramebuffers(FRAMEBUFFERS, raycast->framebuffers);
    attach_maps(raycast, FACES_IN, ENTRY, "ray entry");
    if (raycast->surface == VOLUME_FACETS) {
        raycast->facets = create_map(target, GL_RGBA16F, "facets");
        glNamedFramebufferTexture(raycast->framebuffers[FACES_IN], GL_COLOR_ATTACHMENT0, raycast->facets, 0);
        glNamedFramebufferDrawBuffer(raycast->framebuffers[FACES_IN], GL_COLOR_ATTACHMENT0);
    }
    attach_maps(raycast, FACES_OUT, EXIT, "ray exit");
    attach_maps(raycast, MARCH, GATE, "ray march");
    glNamedFramebufferTexture(raycast->framebuffers[MARCH], GL_COLOR_ATTACHMENT0, target->color, 0);
    glNamedFramebufferTexture(raycast->framebuffers[MARCH], GL_COLOR_ATTACHMENT1, raycast->found, 0);
    glNamedFramebufferDrawBuffers(raycast->framebuffers[MARCH], 2, both);
    raycast->target_number = target->number;
}

/* The grid's sides are along the box's axes: scale, translate, then apply the box's pose. */
static void fill_matrices(RaycastBlock *block, const VolumeGrid *grid, const Frame *frame)
{
    float box_to_eye[16], eye_to_box[16], to_volume[16] = {[15] = 1}, to_box[16] = {[15] = 1};
    for (int k = 0; k < 3; k++) {
        const double size = grid->size[k] * grid->cell;
        to_box[5 * k] = (float)size, to_box[12 + k] = (float)grid->corner[k];
        to_volume[5 * k] = (float)(1 / size), to_volume[12 + k] = (float)(-grid->corner[k] / size);
    }
    matrix_multiply(frame->camera.view, frame->box_to_world, box_to_eye);
    matrix_invert_rigid(box_to_eye, eye_to_box);
    matrix_multiply(to_volume, eye_to_box, block->eye_to_volume);
    matrix_multiply(box_to_eye, to_box, block->volume_to_eye);
}

/* True if part of the near plane is inside the volume: then front faces are clipped, and all rays start at
   the near plane. */
static bool near_is_inside(const RaycastBlock *block, const Frame *frame)
{
    const float reach = frame->camera.near_plane * sqrtf(1 + camera_max_slant_squared(&frame->camera));
    bool inside = true;
    for (int k = 0; k < 3; k++) {
        const float at = block->eye_to_volume[12 + k],
                    margin = reach / (block->volume_cells[k] * block->cell_size);
        inside = inside && at > -margin && at < 1 + margin;
    }
    return inside;
}

/* Walls, or far outside if there are none. Particles at rest are half a spacing from a wall; some are
   pressed nearer and leave holes, which the field at that distance from the wall does not show. */
static void fill_walls(RaycastBlock *block, const Volume *volume, const ParticleBuffers *particles)
{
    const VolumeGrid *grid = &volume->grid;
    for (int k = 0; k < 3; k++) {
        const double size = particles->box_size[k], side = grid->size[k] * grid->cell;
        const double low = ((k == 1 ? 0 : -size / 2) - grid->corner[k]) / side, high = low + size / side;
        const double margin = fmin(0.5 * particles->spacing, 0.25 * size) / side;
        block->wall_low[k] = volume->walled[k] ? (float)low : -1;
        block->wall_high[k] = volume->walled[k] ? (float)high : 2;
        block->field_low[k] = volume->walled[k] ? (float)(low + margin) : -1;
        block->field_high[k] = volume->walled[k] ? (float)(high - margin) : 2;
    }
}

static void fill_march(RaycastBlock *block, const RaycastDef *cast, const Volume *volume)
{
    block->surface_level = (float)cast->level;
    block->step_length = (float)(cast->step * volume->grid.cell);
    block->far_step = (float)(FAR_STEP * volume->support);
    block->enough_light = (float)(1 - cast->threshold);
    block->jitter = cast->jitter;
}

/* For translucent fluid: `opacity` is of fluid one spacing deep. */
static void fill_opacity(RaycastBlock *block, const RaycastDef *cast, double spacing)
{
    block->ramp_begin = (float)cast->ramp[0];
    block->ramp_scale = (float)(1 / fmax(cast->ramp[1] - cast->ramp[0], 1e-6));
    block->extinction = (float)(-log(fmax(1 - cast->opacity, 1e-30)) / spacing);
    block->skin_depth = (float)-log(fmax(1 - cast->skin, 1e-30));
}

static void fill_block(RaycastBlock *block, const Volume *volume, const ParticleBuffers *particles,
                       const Frame *frame)
{
    const RaycastDef *cast = &volume_def(frame->def)->raycast;
    const VolumeGrid *grid = &volume->grid;
    int count[3];
    const int side = bricks_count(grid, count);
    const bool surface = cast->look != RAYCAST_TRANSLUCENT;
    fill_matrices(block, grid, frame);
    for (int k = 0; k < 3; k++) {
        block->volume_cells[k] = (float)grid->size[k];
        block->brick_count[k] = (float)count[k];
    }
    block->cell_size = (float)grid->cell;
    block->brick_side = (float)side;
    block->brick_least = (float)(cast->skip ? surface ? cast->level : cast->ramp[0] : -1);
    fill_walls(block, volume, particles);
    fill_march(block, cast, volume);
    fill_opacity(block, cast, particles->spacing);
    block->near_start = near_is_inside(block, frame) ? frame->camera.near_plane : 0;
}

/* Binds the tables of curves. If particles lack the scalar, opacity is as without a curve. */
static void bind_transfer(Raycast *raycast, const Volume *volume, const ParticleBuffers *particles,
                          const Frame *frame, RaycastBlock *block)
{
    static const ControlPoints even = {1, {0}, {1}};
    const ViewDef *def = frame->def;
    const VolumeOpacity by = volume_opacity(def);
    const bool there = by != VOLUME_EVEN && particles->scalar[scalar_of_curve(&def->opacity)].buffer;
    if (by == VOLUME_EVEN && !raycast_is_curved(def))
        return;
    transfer_bind(&raycast->transfer, &volume_def(def)->raycast.curve, there ? &def->opacity.curve : &even);
    if (by == VOLUME_BY_OWN)
        glBindTextures(OPACITY_FIELD_UNIT, 2, volume->opacity);
    block->opacity_low = (float)frame->curves.opacity[0];
    block->opacity_scale = (float)(1 / (frame->curves.opacity[1] - frame->curves.opacity[0]));
}

/* The nearest front face and the farthest back face in each pixel. Rays to a mesh begin at the triangles. */
static void draw_faces(Raycast *raycast, const Frame *frame)
{
    static const float nothing[2] = {0, 1};
    glViewport(0, 0, frame->width, frame->height);
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glEnable(GL_CULL_FACE);
    glFrontFace(GL_CCW);
    for (int i = FACES_IN; i <= FACES_OUT; i++) {
        glBindFramebuffer(GL_FRAMEBUFFER, raycast->framebuffers[i]);
        glClearNamedFramebufferfv(raycast->framebuffers[i], GL_DEPTH, 0, &nothing[i]);
        glCullFace(i == FACES_IN ? GL_BACK : GL_FRONT);
        glDepthFunc(i == FACES_IN ? GL_GREATER : GL_LESS);
        if (i == FACES_IN && raycast->surface != VOLUME_RAYS)
            surface_mesh_draw(&raycast->mesh);
        else
            bricks_draw_faces(&raycast->bricks);
    }
    glDisable(GL_CULL_FACE);
}

static void copy_depth(GLuint from, GLuint to, const Target *target)
{
    glCopyImageSubData(from, GL_TEXTURE_2D, 0, 0, 0, 0, to, GL_TEXTURE_2D, 0, 0, 0, 0, target->width,
                       target->height, 1);
}

/* The full-screen triangle passes the depth test only at faces: a software driver runs the whole shader
   even if only part of the work is needed. */
static void open_gate(const Raycast *raycast, const Target *target, bool inside)
{
    copy_depth(raycast->depths[inside ? EXIT : ENTRY], raycast->depths[GATE], target);
    glDepthMask(GL_FALSE);
    glDepthFunc(inside ? GL_GREATER : GL_LESS);
    glDepthRange(inside, inside);
}

/* Solids are in the target's depth, which is written only after all rays are cast. */
static void bind_maps(Raycast *raycast, const Frame *frame)
{
    const Target *target = frame->target;
    color_table_bind(&raycast->colors, &frame->def->color_curve);
    glBindTextureUnit(ENTRY_UNIT, raycast->depths[ENTRY]);
    glBindTextureUnit(EXIT_UNIT, raycast->depths[EXIT]);
    if (raycast->facets)
        glBindTextureUnit(FACETS_UNIT, raycast->facets);
    glBindTextureUnit(TARGET_DEPTH_UNIT, raycast->solids ? target->depth : 0);
}

/* Without solids, only sky, floor and the box's edges are visible through the fluid: sky and floor need no
   copy. */
static void look_through(Raycast *raycast, const Frame *frame)
{
    const RaycastDef *cast = &volume_def(frame->def)->raycast;
    if (raycast->solids)
        background_copy_make(&raycast->background, &raycast->edges, frame);
    else if (raycast_is_full(frame->def))
        background_copy_make_edges(&raycast->background, &raycast->edges, frame);
    else
        glBindTextureUnit(FLOOR_LIGHT_UNIT, frame->floor.light);
    const GLuint programs[] = {raycast->program, raycast->drops.program};
    for (int i = 0; i < 2 && programs[i]; i++) {
        glProgramUniform1f(programs[i], REFRACTION_INDEX_AT, (GLfloat)cast->ior);
        glProgramUniform1f(programs[i], ATTENUATION_AT,
                           cast->attenuation > 0 ? (GLfloat)cast->attenuation : frame->fluid.attenuation);
    }
}

/* Rays end at solids: hits are always in front of solids. */
static void march(Raycast *raycast, const Frame *frame, bool inside)
{
    static const float nothing[4] = {0};
    glBindFramebuffer(GL_FRAMEBUFFER, raycast->framebuffers[MARCH]);
    glClearNamedFramebufferfv(raycast->framebuffers[MARCH], GL_COLOR, 1, nothing);
    open_gate(raycast, frame->target, inside);
    if (raycast->look == RAYCAST_TRANSLUCENT)
        glEnablei(GL_BLEND, 0);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    bind_maps(raycast, frame);
    glUseProgram(raycast->program);
    glBindVertexArray(raycast->screen);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_BLEND);
    glDepthRange(0, 1);
}

static void write_depth(const Raycast *raycast, const Frame *frame)
{
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_ALWAYS);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glBindTextureUnit(FOUND_UNIT, raycast->found);
    glUseProgram(raycast->settle);
    glBindVertexArray(raycast->screen);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDisable(GL_DEPTH_TEST);
}

/* As uniforms: Mesa's zink over lavapipe (22.3) crashes if this vertex shader reads the block. */
static void say_where_drops_are(GLuint program, const RaycastBlock *block, const VolumeGrid *grid)
{
    const double *corner = grid->corner, side = grid->cell;
    const float *low = block->field_low, *high = block->field_high;
    glProgramUniform3f(program, DROPS_CORNER_AT, (GLfloat)corner[0], (GLfloat)corner[1], (GLfloat)corner[2]);
    glProgramUniform3f(program, DROPS_PER_SIDE_AT, (GLfloat)(1 / (grid->size[0] * side)),
                       (GLfloat)(1 / (grid->size[1] * side)), (GLfloat)(1 / (grid->size[2] * side)));
    glProgramUniform3f(program, DROPS_LOW_AT, low[0], low[1], low[2]);
    glProgramUniform3f(program, DROPS_HIGH_AT, high[0], high[1], high[2]);
    glProgramUniform1f(program, DROPS_LEVEL_AT, block->surface_level);
}

static void cast_rays(Raycast *raycast, const Volume *volume, const ParticleBuffers *particles,
                      const Frame *frame)
{
    RaycastBlock block = {0};
    follow_target(raycast, frame->target);
    fill_block(&block, volume, particles, frame);
    bind_transfer(raycast, volume, particles, frame, &block);
    glNamedBufferSubData(raycast->block, 0, sizeof block, &block);
    glBindBufferBase(GL_UNIFORM_BUFFER, RAYCAST_BLOCK, raycast->block);
    glBindTextures(FIELD_UNIT, 2, (GLuint[]){volume->field, volume->scalar});
    if (volume->tint[0])
        glBindTextures(GREEN_UNIT, 2, volume->tint);
    bricks_make(&raycast->bricks, volume);
    if (raycast->surface != VOLUME_RAYS)
        surface_mesh_make(&raycast->mesh, &volume->grid, raycast->bricks.size);
    draw_faces(raycast, frame);
    if (raycast->look == RAYCAST_WATER)
        look_through(raycast, frame);
    march(raycast, frame, block.near_start > 0);
    write_depth(raycast, frame);
    if (raycast->drops.program && particles->count > 0) {
        say_where_drops_are(raycast->drops.program, &block, &volume->grid);
        volume_drops_draw(&raycast->drops, particles, frame);
    }
}

/* Counts pixels with written depth: for translucent fluid, pixels with at least half opacity. */
static void count_covered(const Raycast *raycast, const Frame *frame)
{
    ViewCounts *counts = frame->counts;
    counts_begin(counts);
    write_depth(raycast, frame);
    counts_end(counts, STAGE_RAYCAST);
    const uint64_t covered = (uint64_t)counts->fragments[STAGE_RAYCAST];
    counts->fragments[STAGE_RAYCAST] = 0;
    counts_finish(counts, covered, (uint64_t)frame->width * (uint64_t)frame->height);
}

void raycast_draw(Raycast *raycast, const Volume *volume, const Voxelizer *voxelizer,
                  const ParticleBuffers *particles, const Frame *frame)
{
    if (voxelizer)
        voxelizer_bind(voxelizer);
    GL_STAGE(frame->timer, STAGE_RAYCAST)
    cast_rays(raycast, volume, particles, frame);
    if (frame->counts)
        count_covered(raycast, frame);
}

RaycastMaps raycast_maps(const Raycast *raycast)
{
    return (RaycastMaps){raycast->depths[ENTRY], raycast->depths[EXIT], raycast->bricks.map};
}

const SurfaceMesh *raycast_mesh(const Raycast *raycast)
{
    return &raycast->mesh;
}

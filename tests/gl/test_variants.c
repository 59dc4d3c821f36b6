/* A small world and a small picture for each variant of the shaders. Every source sent to the driver is
   validated by glslangValidator. Buffers written by dispatches and then cleared, filled or copied by the
   context are behind a matching barrier. No program has a buffer in two blocks, and no solver program has
   a block without a buffer. */
#include "tests/gl/compare.h"
#include "tests/lists.h"
#include "tests/scratch.h"
#include "tests/sim/toy_method.h"
#include "tests/sim/toy_shaders.h"

#include "render/frame/view.h"
#include "render/overlays/glyphs/glyphs.h"
#include "render/overlays/streamlines/streamlines.h"
#include "render/overlays/trails/trails.h"
#include "render/particles/particles.h"
#include "render/renderer.h"
#include "render/views/pbsr/pbsr.h"
#include "render/views/slice/slice.h"
#include "sim/base/base.h"
#include "sim/def/fluids.h"
#include "sim/gpu/gl.h"
#include "sim/methods/mueller/mueller.h"
#include "sim/methods/wcsph/wcsph.h"

#include <epoxy/gl.h>

/* The program calls through these pointers. */
#define ENTRIES(X)                                                                                           \
    X(glCompileShader)                                                                                       \
    X(glGetShaderiv)                                                                                         \
    X(glGetProgramiv)                                                                                        \
    X(glUseProgram)                                                                                          \
    X(glLinkProgram)                                                                                         \
    X(glShaderSource)                                                                                        \
    X(glDispatchComputeIndirect)                                                                             \
    X(glDispatchCompute)                                                                                     \
    X(glMemoryBarrier)                                                                                       \
    X(glBindImageTexture)                                                                                    \
    X(glClearNamedBufferData)                                                                                \
    X(glClearNamedBufferSubData)                                                                             \
    X(glNamedBufferSubData)                                                                                  \
    X(glGetNamedBufferSubData)                                                                               \
    X(glCopyNamedBufferSubData)                                                                              \
    X(glClearTexImage)
#define X(name) static __typeof__(epoxy_##name) real_##name;
ENTRIES(X)
#undef X

/* During the variants the driver skips compiling and reports success: compiling takes minutes. */
static bool texts_only;

static void APIENTRY maybe_compile(GLuint shader)
{
    if (!texts_only)
        real_glCompileShader(shader);
}

static void APIENTRY maybe_use(GLuint program)
{
    real_glUseProgram(texts_only ? 0 : program);
}

static void APIENTRY say_compiled(GLuint shader, GLenum what, GLint *value)
{
    real_glGetShaderiv(shader, what, value);
    if (texts_only && what == GL_COMPILE_STATUS)
        *value = GL_TRUE;
}

static void APIENTRY say_linked(GLuint program, GLenum what, GLint *value)
{
    real_glGetProgramiv(program, what, value);
    if (texts_only && what == GL_LINK_STATUS)
        *value = GL_TRUE;
}

/* Sources: a file each, named by stage for the validator. */
static char folder[SCRATCH_SIZE];
static size_t sources;

static const char *ending_of(GLuint shader)
{
    GLint kind = 0;
    glGetShaderiv(shader, GL_SHADER_TYPE, &kind);
    switch ((GLenum)kind) {
    case GL_VERTEX_SHADER:
        return "vert";
    case GL_GEOMETRY_SHADER:
        return "geom";
    case GL_FRAGMENT_SHADER:
        return "frag";
    default:
        return "comp";
    }
}

/* The validator knows the same functions by their newer name only. */
static void write_source(FILE *file, const char *text)
{
    static const char known[] = "GL_NV_shader_atomic_float";
    const char *at = strstr(text, known);
    if (at)
        fprintf(file, "%.*sGL_EXT_shader_atomic_float%s", (int)(at - text), text, at + strlen(known));
    else
        fputs(text, file);
}

static void APIENTRY keep_source(GLuint shader, GLsizei count, const GLchar *const *text, const GLint *length)
{
    char name[SCRATCH_PATH];
    snprintf(name, sizeof name, "%s/%016lx.%s", folder,
             (unsigned long)hash_add(HASH_NONE, text[0], strlen(text[0])), ending_of(shader));
    FILE *file = fopen(name, "wx"); /* the same source is kept once */
    if (file) {
        sources++;
        write_source(file, text[0]);
        assert_int_equal(fclose(file), 0);
    }
    real_glShaderSource(shader, count, text, length);
}

/* Maximum per program: render/frame/view.c and sim/gpu/compute/compute.c request as many from drivers. Mesa
   does not report the stage of a block: for pictures all blocks of the program count. */
static GlLimits most;

static void note_most(int *most_so_far, int value)
{
    if (value > *most_so_far)
        *most_so_far = value;
}

static void APIENTRY note_program(GLuint program)
{
    const GLenum what = GL_BUFFER_BINDING;
    GLuint first = 0;
    GLsizei stages = 0;
    GLint count = 0, kind = 0, binding = 0;
    if (texts_only)
        return;
    real_glLinkProgram(program);
    glGetAttachedShaders(program, 1, &stages, &first);
    glGetShaderiv(first, GL_SHADER_TYPE, &kind);
    glGetProgramInterfaceiv(program, GL_SHADER_STORAGE_BLOCK, GL_ACTIVE_RESOURCES, &count);
    note_most(kind == GL_COMPUTE_SHADER ? &most.compute_blocks : &most.vertex_blocks, count);
    for (GLint block = 0; block < count; block++) {
        glGetProgramResourceiv(program, GL_SHADER_STORAGE_BLOCK, (GLuint)block, 1, &what, 1, NULL, &binding);
        note_most(&most.bindings, binding + 1);
    }
}

/* By GL name: what dispatches may have written since the last barrier for such commands. */
enum { NAMES_MAX = 16384, UNITS_MAX = 8, BLOCKS_MAX = 32 };
static bool buffer_written[NAMES_MAX], texture_written[NAMES_MAX];
static GLuint image_at[UNITS_MAX];
static int dispatches, commands, violations, unbound;
static bool worlds_only;

/* A buffer in two blocks of a program: a compiler may assume two buffers. */
static void check_alone(GLuint buffer, GLuint seen[], int *count)
{
    char label[64] = "", program[64] = "";
    GLint used = 0;
    for (int k = 0; k < *count; k++)
        if (seen[k] == buffer) {
            glGetIntegerv(GL_CURRENT_PROGRAM, &used);
            glGetObjectLabel(GL_PROGRAM, (GLuint)used, sizeof program, NULL, program);
            glGetObjectLabel(GL_BUFFER, buffer, sizeof label, NULL, label);
            printf("%s: \"%s\" stands in two blocks\n", program, label);
            violations++;
        }
    assert_true(*count < BLOCKS_MAX);
    seen[(*count)++] = buffer;
}

static void note_unbound(GLuint program, GLint binding)
{
    char label[64] = "";
    unbound++;
    if (!worlds_only)
        return;
    glGetObjectLabel(GL_PROGRAM, program, sizeof label, NULL, label);
    printf("%s: no buffer at binding %d\n", label, binding);
}

/* The buffers behind the program's blocks of that kind. */
static void note_blocks(GLuint program, GLenum kind, GLenum bound, GLuint seen[], int *seen_count)
{
    GLint count = 0;
    glGetProgramInterfaceiv(program, kind, GL_ACTIVE_RESOURCES, &count);
    for (GLint block = 0; block < count; block++) {
        const GLenum what = GL_BUFFER_BINDING;
        GLint binding = 0, buffer = 0;
        glGetProgramResourceiv(program, kind, (GLuint)block, 1, &what, 1, NULL, &binding);
        glGetIntegeri_v(bound, (GLuint)binding, &buffer);
        assert_true(buffer >= 0 && buffer < NAMES_MAX);
        if (buffer == 0) {
            note_unbound(program, binding);
            continue;
        }
        check_alone((GLuint)buffer, seen, seen_count);
        if (kind == GL_SHADER_STORAGE_BLOCK)
            buffer_written[buffer] = true;
    }
}

static void note_images(GLuint program)
{
    GLint count = 0;
    glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    for (GLint k = 0; k < count; k++) {
        GLchar name[64];
        GLint size = 0, unit = 0;
        GLenum type = 0;
        glGetActiveUniform(program, (GLuint)k, sizeof name, NULL, &size, &type, name);
        if (type != GL_IMAGE_3D && type != GL_UNSIGNED_INT_IMAGE_3D)
            continue;
        glGetUniformiv(program, glGetUniformLocation(program, name), &unit);
        assert_true(unit >= 0 && unit < UNITS_MAX);
        texture_written[image_at[unit]] = image_at[unit] != 0;
    }
}

/* What the program in use may write. */
static void note_written(void)
{
    GLint program = 0;
    GLuint seen[BLOCKS_MAX];
    int count = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &program);
    note_blocks((GLuint)program, GL_UNIFORM_BLOCK, GL_UNIFORM_BUFFER_BINDING, seen, &count);
    note_blocks((GLuint)program, GL_SHADER_STORAGE_BLOCK, GL_SHADER_STORAGE_BUFFER_BINDING, seen, &count);
    note_images((GLuint)program);
    dispatches++;
}

static void APIENTRY note_dispatch(GLuint x, GLuint y, GLuint z)
{
    if (texts_only)
        return;
    note_written();
    real_glDispatchCompute(x, y, z);
}

static void APIENTRY note_decided_dispatch(GLintptr at)
{
    if (texts_only)
        return;
    note_written();
    real_glDispatchComputeIndirect(at);
}

static void APIENTRY note_barrier(GLbitfield bits)
{
    if (bits & GL_BUFFER_UPDATE_BARRIER_BIT)
        memset(buffer_written, 0, sizeof buffer_written);
    if (bits & GL_TEXTURE_UPDATE_BARRIER_BIT)
        memset(texture_written, 0, sizeof texture_written);
    real_glMemoryBarrier(bits);
}

static void APIENTRY note_image(GLuint unit, GLuint texture, GLint level, GLboolean layered, GLint layer,
                                GLenum access, GLenum format)
{
    assert_true(unit < UNITS_MAX && texture < NAMES_MAX);
    image_at[unit] = access == GL_READ_ONLY ? 0 : texture;
    real_glBindImageTexture(unit, texture, level, layered, layer, access, format);
}

static void check(const bool *written, GLenum kind, GLuint name, const char *what)
{
    char label[64] = "";
    commands += !texts_only;
    if (name >= NAMES_MAX || !written[name])
        return;
    glGetObjectLabel(kind, name, sizeof label, NULL, label);
    printf("%s of \"%s\" behind a dispatch without a barrier\n", what, label);
    violations++;
}

static void APIENTRY note_clear(GLuint buffer, GLenum internal, GLenum format, GLenum type, const void *data)
{
    check(buffer_written, GL_BUFFER, buffer, "glClearNamedBufferData");
    real_glClearNamedBufferData(buffer, internal, format, type, data);
}

static void APIENTRY note_clear_part(GLuint buffer, GLenum internal, GLintptr at, GLsizeiptr size,
                                     GLenum format, GLenum type, const void *data)
{
    check(buffer_written, GL_BUFFER, buffer, "glClearNamedBufferSubData");
    real_glClearNamedBufferSubData(buffer, internal, at, size, format, type, data);
}

static void APIENTRY note_put(GLuint buffer, GLintptr at, GLsizeiptr size, const void *data)
{
    check(buffer_written, GL_BUFFER, buffer, "glNamedBufferSubData");
    real_glNamedBufferSubData(buffer, at, size, data);
}

static void APIENTRY note_get(GLuint buffer, GLintptr at, GLsizeiptr size, void *data)
{
    check(buffer_written, GL_BUFFER, buffer, "glGetNamedBufferSubData");
    real_glGetNamedBufferSubData(buffer, at, size, data);
}

static void APIENTRY note_copy(GLuint from, GLuint to, GLintptr at, GLintptr where, GLsizeiptr size)
{
    check(buffer_written, GL_BUFFER, from, "glCopyNamedBufferSubData");
    check(buffer_written, GL_BUFFER, to, "glCopyNamedBufferSubData");
    real_glCopyNamedBufferSubData(from, to, at, where, size);
}

static void APIENTRY note_clear_texture(GLuint texture, GLint level, GLenum format, GLenum type,
                                        const void *data)
{
    check(texture_written, GL_TEXTURE, texture, "glClearTexImage");
    real_glClearTexImage(texture, level, format, type, data);
}

static void watch_entries(void)
{
#define X(name) real_##name = epoxy_##name;
    ENTRIES(X)
#undef X
    epoxy_glCompileShader = maybe_compile;
    epoxy_glUseProgram = maybe_use;
    epoxy_glGetShaderiv = say_compiled;
    epoxy_glGetProgramiv = say_linked;
    epoxy_glLinkProgram = note_program;
    epoxy_glShaderSource = keep_source;
    epoxy_glDispatchCompute = note_dispatch;
    epoxy_glDispatchComputeIndirect = note_decided_dispatch;
    epoxy_glMemoryBarrier = note_barrier;
    epoxy_glBindImageTexture = note_image;
    epoxy_glClearNamedBufferData = note_clear;
    epoxy_glClearNamedBufferSubData = note_clear_part;
    epoxy_glNamedBufferSubData = note_put;
    epoxy_glGetNamedBufferSubData = note_get;
    epoxy_glCopyNamedBufferSubData = note_copy;
    epoxy_glClearTexImage = note_clear_texture;
}

/* Names are given anew. */
static void forget(void)
{
    memset(buffer_written, 0, sizeof buffer_written);
    memset(texture_written, 0, sizeof texture_written);
    memset(image_at, 0, sizeof image_at);
}

/* A def is large, and a frame that holds all variants is more than a stack under the sanitizers. */
#define NOINLINE __attribute__((noinline))

static WorldDef pool_def(const char *backend)
{
    WorldDef def = fixture_def(0.8, 0.6, 0.5);
    def.sound_speed = 20;
    *world_threads(&def) = 1;
    def.retries = 1;
    def.reproducible = false;
    def.fluids[0].viscosity = 1;
    snprintf(def.backend, sizeof def.backend, "%s", backend);
    fixture_block(&def, 0, -0.4, 0, -0.25, 0.2, 0.3, 0.25);
    return def;
}

static void with_a_ball(SolidDef solids[], int *count)
{
    solids[(*count)++] = (SolidDef){
        .kind = SOLID_SPHERE, .centre = {0.2, 0.3, 0}, .radius = 0.12, .axis = {0, 1, 0}, .slip = SLIP_NONE};
}

/* As many as no pass can tell apart by one number between two colours. */
static void add_fluids(WorldDef *def)
{
    for (int f = 1; f < 3; f++) {
        def->fluids[f] = def->fluids[0];
        def->fluids[f].fill_count = 0;
        def->fluids[f].density = 1000 - 100 * f;
        fixture_block(def, f, 0.2 * f, -0.25, -0.25, 0.2 * f + 0.15, 0.1, 0.25);
    }
    def->fluid_count = 3;
}

static void add_flow(WorldDef *def)
{
    def->most = 1000;
    add_emit(&def->fluids[0],
             (Emit){.centre = {-0.2, 0.45, 0}, .direction = {0, -1, 0}, .radius = 0.12, .speed = 1});
    add_drain(def, (Fill){.kind = FILL_BLOCK, .min = {0.1, 0, -0.25}, .max = {0.4, 0.1, 0.25}});
}

/* Two steps, all requests of views and measurements, and a save. */
static void live(const WorldDef *def)
{
    World *world = fixture_world(def);
    ParticleBuffers shared;
    const double still[3] = {0};
    Error error = {0};
    Forces forces;
    if (world->backend->enable_forces)
        assert_true(world_enable_forces(world, &error));
    fixture_step(world, 2);
    world_share(world, PARTICLE_SCALAR(SCALAR_SPEED) | PARTICLE_FLUID, &shared);
    world->backend->gauge(world->state, still);
    fixture_step(world, 1);
    world_forces(world, &forces);
    Snapshot read = snapshot_read(world);
    snapshot_free(&read);
    world_destroy(world);
    forget();
}

#define LIVE(def, ...)                                                                                       \
    do {                                                                                                     \
        WorldDef d = def;                                                                                    \
        __VA_ARGS__;                                                                                         \
        live(&d);                                                                                            \
    } while (0)

static void set_name(char name[NAME_SIZE], const char *value)
{
    snprintf(name, NAME_SIZE, "%s", value);
}

NOINLINE static void mueller_lives(const char *backend)
{
    const WorldDef base = pool_def(backend);
    LIVE(base, d.reproducible = true, d.fluids[0].viscosity = 0);
    LIVE(base, d.dimensions = 2, set_name(mueller_def(&d)->density_kernel, "poly6"),
         d.negative_pressure = true);
    LIVE(base, set_name(mueller_def(&d)->density_kernel, "quintic"));
}

NOINLINE static void mueller_has_more_on_compute(void)
{
    const WorldDef base = pool_def("compute");
    LIVE(base, d.periodic[0] = true);
    LIVE(base, d.tension_model = TENSION_COLOUR_FIELD, d.fluids[0].surface_tension = 0.1);
    LIVE(base, d.tension_model = TENSION_COHESION, d.fluids[0].surface_tension = 0.1);
    LIVE(base, d.wall_slip = SLIP_NONE, d.lid[0] = 0.1);
    LIVE(base, d.wall_slip = SLIP_NONE, d.periodic[2] = true, d.reproducible = true);
    LIVE(base, with_a_ball(d.solids, &d.solid_count), d.reproducible = true);
    LIVE(base, with_a_ball(d.solids, &d.solid_count), d.periodic[2] = true, add_flow(&d));
    LIVE(base, add_flow(&d));
    LIVE(base, add_fluids(&d));
}

NOINLINE static void wcsph_lives(void)
{
    WorldDef base = pool_def("compute");
    set_name(base.method, "wcsph");
    base.dt = 0.0005;
    LIVE(base, wcsph_def(&d)->viscosity_form = VISCOSITY_RADIAL, d.negative_pressure = true);
    LIVE(base, wcsph_def(&d)->delta_sph = 0.1, set_name(wcsph_def(&d)->kernel, "wendland_c2"));
    LIVE(base, wcsph_def(&d)->delta_sph = 0.1, wcsph_def(&d)->shifting = 0.1,
         set_name(wcsph_def(&d)->kernel, "wendland_c2"), d.reproducible = true);
    LIVE(base, wcsph_def(&d)->delta_sph = 0.1, wcsph_def(&d)->shifting = 0.1,
         set_name(wcsph_def(&d)->kernel, "quintic"), d.periodic[0] = true);
    LIVE(base, d.fluids[0].viscosity = 0, wcsph_def(&d)->artificial_viscosity = 0.1);
    LIVE(base, with_a_ball(d.solids, &d.solid_count), wcsph_def(&d)->shifting = 0.1,
         wcsph_def(&d)->delta_sph = 0.1, add_flow(&d));
    LIVE(base, d.dimensions = 2, d.tension_model = TENSION_COHESION, d.fluids[0].surface_tension = 0.1);
    LIVE(base, d.tension_model = TENSION_CURVATURE, d.fluids[0].surface_tension = 0.1,
         with_a_ball(d.solids, &d.solid_count), wcsph_def(&d)->shifting = 0.2);
    LIVE(base, d.tension_model = TENSION_CURVATURE, d.fluids[0].surface_tension = 0.1, d.periodic[0] = true,
         wcsph_def(&d)->corrected_gradient = true);
}

NOINLINE static void implicit_viscosity_lives(void)
{
    WorldDef base = pool_def("compute");
    base.viscosity_solver = VISCOSITY_IMPLICIT;
    LIVE(base, d.wall_slip = SLIP_NONE, d.lid[0] = 0.1);
    LIVE(base, with_a_ball(d.solids, &d.solid_count), d.reproducible = true);
    LIVE(base, d.periodic[0] = true, d.dt = 0.0005, set_name(d.method, "wcsph"),
         set_name(wcsph_def(&d)->kernel, "quintic"));
}

/* dfsph, pbf. */
NOINLINE static void incompressible_lives(const char *method)
{
    WorldDef base = pool_def("compute");
    set_name(base.method, method);
    LIVE(base, d.fluids[0].viscosity = 0);
    LIVE(base, d.negative_pressure = true, d.reproducible = true);
    LIVE(base, d.periodic[0] = true, d.tension_model = TENSION_COHESION, d.fluids[0].surface_tension = 0.1);
    LIVE(base, with_a_ball(d.solids, &d.solid_count), add_flow(&d));
    LIVE(base, d.dimensions = 2, d.tension_model = TENSION_COLOUR_FIELD, d.fluids[0].surface_tension = 0.1);
}

enum { VIEWS_MAX = 128 };

/* Every view, with all settings that change shaders. */
static int views_of(ViewDef base, ViewDef views[VIEWS_MAX])
{
    int count = 0;
#define VIEW(name, ...)                                                                                      \
    do {                                                                                                     \
        ViewDef v = base;                                                                                    \
        set_name(v.kind, name);                                                                              \
        __VA_ARGS__;                                                                                         \
        assert_true(count < VIEWS_MAX);                                                                      \
        views[count++] = v;                                                                                  \
    } while (0)
    VIEW("spheres", v.floor = true);
    for (int scalar = 0; scalar < SCALAR_COUNT; scalar += scalar == SCALAR_OWN ? SCALAR_BORN - scalar : 1)
        VIEW("spheres", v.color_by = (Scalar)scalar);
    VIEW("spheres", v.size.by = 1 + SCALAR_PRESSURE);
    VIEW("spheres", v.opacity.by = 1 + SCALAR_PRESSURE);
    VIEW("spheres", v.size.by = v.opacity.by = 1 + SCALAR_DENSITY);
    VIEW("spheres", v.size.by = 1 + SCALAR_VORTICITY, v.opacity.by = 1 + SCALAR_NEIGHBOURS);
    for (int shape = SPLAT_PERSPECTIVE; shape <= SPLAT_ELLIPSOID; shape++) {
        VIEW("splat", splat_def(&v)->shape = (SplatShape)shape);
        VIEW("splat", splat_def(&v)->shape = (SplatShape)shape, splat_def(&v)->cull = true,
             splat_def(&v)->sprite = SPLAT_QUAD);
        VIEW("splat", splat_def(&v)->shape = (SplatShape)shape, splat_def(&v)->sprite = SPLAT_POINT,
             splat_def(&v)->antialias = true);
        VIEW("splat", splat_def(&v)->shape = (SplatShape)shape, splat_def(&v)->drops = true,
             splat_def(&v)->sprite = SPLAT_POINT);
        VIEW("splat", splat_def(&v)->shape = (SplatShape)shape, splat_def(&v)->drops = true,
             splat_def(&v)->sprite = SPLAT_QUAD);
        VIEW("splat", splat_def(&v)->shape = (SplatShape)shape, splat_def(&v)->filter = SPLAT_NARROW_RANGE,
             splat_def(&v)->antialias = true, splat_def(&v)->cull = true);
    }
    for (int shape = SPLAT_PERSPECTIVE; shape <= SPLAT_ELLIPSOID; shape++) {
        VIEW("splat", splat_def(&v)->shape = (SplatShape)shape, v.size.by = 1 + SCALAR_PRESSURE);
        VIEW("splat", splat_def(&v)->shape = (SplatShape)shape, v.size.by = 1 + SCALAR_PRESSURE,
             splat_def(&v)->drops = false);
    }
    for (int shape = SPLAT_PERSPECTIVE; shape <= SPLAT_PAPER; shape++) {
        VIEW("splat", splat_def(&v)->shape = (SplatShape)shape, splat_def(&v)->level = 0.3,
             splat_def(&v)->sprite = SPLAT_POINT);
        VIEW("splat", splat_def(&v)->shape = (SplatShape)shape, splat_def(&v)->level = 0.3,
             splat_def(&v)->sprite = SPLAT_QUAD, v.color_by = SCALAR_FLUID);
    }
    for (int weights = SPLAT_NO_WEIGHTS; weights <= SPLAT_W2; weights++)
        VIEW("splat", splat_def(&v)->weights = (SplatWeights)weights);
    for (int shading = SPLAT_WATER; shading <= SPLAT_JELLY; shading++) {
        VIEW("splat", splat_def(&v)->shading = (SplatShading)shading, v.floor = true);
        VIEW("splat", splat_def(&v)->shading = (SplatShading)shading, splat_def(&v)->antialias = true,
             v.floor = false);
    }
    for (int show = SPLAT_DEPTH; show <= SPLAT_CULLED; show++)
        VIEW("splat", splat_def(&v)->show = (SplatShow)show, splat_def(&v)->cull = show == SPLAT_CULLED);
    VIEW("splat", splat_def(&v)->shape = SPLAT_ELLIPSOID, splat_def(&v)->shading = SPLAT_WATER,
         splat_def(&v)->drops = true);
    for (int method = VOLUME_GEOMETRY; method <= VOLUME_DIRECT; method++) {
        VIEW("volume", volume_def(&v)->method = (VolumeMethod)method);
        VIEW("volume", volume_def(&v)->method = (VolumeMethod)method,
             volume_def(&v)->raycast.look = RAYCAST_TRANSLUCENT, volume_def(&v)->bounds = VOLUME_FLUID);
    }
    for (int look = RAYCAST_OPAQUE; look <= RAYCAST_TRANSLUCENT; look++) {
        VIEW("volume", volume_def(&v)->raycast.look = (RaycastLook)look,
             volume_def(&v)->raycast.shadows = !volume_def(&v)->raycast.shadows, v.floor = true);
        VIEW("volume", volume_def(&v)->raycast.look = (RaycastLook)look, v.quality = VIEW_DRAFT);
        VIEW("volume", volume_def(&v)->raycast.look = (RaycastLook)look,
             volume_def(&v)->raycast.jitter = !volume_def(&v)->raycast.jitter,
             volume_def(&v)->raycast.skip = !volume_def(&v)->raycast.skip,
             v.opacity.by = 1 + SCALAR_PRESSURE);
        VIEW("volume", volume_def(&v)->raycast.look = (RaycastLook)look,
             v.opacity.by = 1 + (int)view_color_by(&v),
             volume_def(&v)->raycast.curve = volume_presets[3].points);
    }
    VIEW("volume", volume_def(&v)->surface = VOLUME_MESH);
    VIEW("volume", volume_def(&v)->surface = VOLUME_FACETS, volume_def(&v)->raycast.look = RAYCAST_WATER);
    for (int show = VOLUME_SLICE; show <= VOLUME_NORMALS; show++)
        VIEW("volume", volume_def(&v)->show = (VolumeShow)show);
    for (int look = RAYCAST_OPAQUE; look <= RAYCAST_TRANSLUCENT; look++)
        VIEW("volume", v.color_by = SCALAR_FLUID, volume_def(&v)->raycast.look = (RaycastLook)look);
    VIEW("slice", v.color_by = SCALAR_FLUID);
    for (int kernel = 1; plane_kernels[kernel].name; kernel++)
        VIEW("slice", slice_def(&v)->kernel = kernel);
    VIEW("slice", v.opacity.by = 1 + SCALAR_PRESSURE);
    VIEW("none", trails_def(&v)->show = true, trails_def(&v)->stride = 1);
    VIEW("spheres", glyphs_def(&v)->show = true, glyphs_def(&v)->at = GLYPHS_GRID);
    VIEW("spheres", streamlines_def(&v)->show = true);
    return count;
}

/* Methods with passes that write values read by neighbours. */
static int few_views_of(ViewDef base, ViewDef views[VIEWS_MAX])
{
    int count = 0;
    VIEW("spheres", v.color_by = SCALAR_VORTICITY);
    VIEW("spheres", v.color_by = SCALAR_KINETIC_ENERGY);
    VIEW("spheres", v.size.by = v.opacity.by = 1 + SCALAR_DENSITY);
    VIEW("splat", splat_def(&v)->cull = true, v.floor = true);
    VIEW("splat", splat_def(&v)->shape = SPLAT_ELLIPSOID, splat_def(&v)->cull = true);
    VIEW("splat", splat_def(&v)->shape = SPLAT_ELLIPSOID, v.size.by = 1 + SCALAR_PRESSURE);
    VIEW("splat", v.size.by = 1 + SCALAR_PRESSURE, splat_def(&v)->drops = false);
    VIEW("splat", splat_def(&v)->shape = SPLAT_ELLIPSOID, splat_def(&v)->cull = false);
    VIEW("volume", volume_def(&v)->method = VOLUME_DIRECT);
    VIEW("volume", volume_def(&v)->method = VOLUME_LAYERS);
    VIEW("volume", volume_def(&v)->method = VOLUME_SCATTER,
         volume_def(&v)->raycast.look = RAYCAST_TRANSLUCENT, v.opacity.by = 1 + SCALAR_DENSITY,
         volume_def(&v)->bounds = VOLUME_FLUID);
    VIEW("volume", volume_def(&v)->method = VOLUME_GATHER, volume_def(&v)->raycast.look = RAYCAST_TRANSLUCENT,
         volume_def(&v)->raycast.curve = volume_presets[2].points, v.opacity.by = 1 + (int)view_color_by(&v));
    VIEW("volume", v.color_by = SCALAR_FLUID);
    VIEW("slice", v.color_by = SCALAR_FLUID);
    VIEW("slice", slice_def(&v)->show = SLICE_FLAT);
    VIEW("slice", slice_def(&v)->particles = SLICE_BEHIND);
    VIEW("pbsr");
    VIEW("pbsr", pbsr_def(&v)->method = PBSR_GPU);
    VIEW("spheres", trails_def(&v)->show = true, trails_def(&v)->through = 0.5);
    VIEW("spheres", glyphs_def(&v)->show = true, glyphs_def(&v)->stride = 1);
    VIEW("spheres", glyphs_def(&v)->show = true, glyphs_def(&v)->at = GLYPHS_GRID);
    VIEW("spheres", streamlines_def(&v)->show = true);
    return count;
}

static void assert_views_have_what_they_ask_for(void)
{
    printf("views have up to %d storage blocks in a vertex shader, %d in a compute shader, %d bindings\n",
           most.vertex_blocks, most.compute_blocks, most.bindings);
    assert_true(most.vertex_blocks == 5 && most.compute_blocks <= 8 && most.bindings == 11);
}

/* Which no view asks for. */
static void make_vectors(void)
{
    const ParticleWants wants = {.vectors = (1U << VECTOR_COUNT) - 1};
    Derived derived = {0};
    Error error = {0};
    if (!derived_update(&derived, &wants, &error))
        fail_msg("%s", error.message);
    derived_destroy(&derived);
}

NOINLINE static void draw_views(const WorldDef *def, bool solids)
{
    static ViewDef views[VIEWS_MAX];
    ViewDef base = view_def_default();
    const ViewProbeRequest asks = {.count = 1, .mouse = true};
    ViewProbeAnswers told;
    Error error = {0};
    WorldDef shown = *def;
    volume_def(&base)->cells = 16;
    if (solids)
        with_a_ball(shown.solids, &shown.solid_count);
    const int count = texts_only ? views_of(base, views) : few_views_of(base, views);
    const GlLimits views_most = most;
    World *world = fixture_world(def);
    fixture_step(world, 1);
    most = views_most; /* the solver's programs do not count */
    Renderer *renderer = renderer_create(&base, &shown, 48, 32, &error);
    assert_non_null(renderer);
    for (int k = 0; k < count; k++) {
        ParticleBuffers particles;
        if (!renderer_set_def(renderer, &views[k], &shown, &error))
            fail_msg("%s %d: %s", views[k].kind, k, error.message);
        world_share(world, renderer_attributes(&views[k]), &particles);
        for (int frame = 0; frame < 2; frame++) /* nobody else's barriers in between */
            renderer_draw(renderer, &particles, NULL);
        renderer_probe(renderer, &asks, &told);
    }
    if (texts_only)
        make_vectors();
    renderer_destroy(renderer);
    world_destroy(world);
    forget();
}

/* All forms of all shaders, of which no step and no picture comes. */
/* A method with additional columns. */
static void toy_lives(void)
{
    const WorldDef base = pool_def("compute");
    toy_shaders_add();
    LIVE(base, set_name(d.method, "toy"), add_flow(&d));
    toy_shaders_remove();
}

/* Walks on surfaces, of each field that has a shader. */
NOINLINE static void surfaces_are_walked_on(void)
{
    static const char *const fields[] = {"sphere",    "torus",       "gyroid", "wave",      "plane",
                                         "trilinear", "catmull_rom", "sph",    "sph_scalar"};
    static const char *const stages[][2] = {
        {"surface/walk.comp"}, {"surface/colour.comp"}, {"surface/count.comp"}};
    for (size_t k = 0; k < sizeof fields / sizeof *fields; k++)
        for (size_t s = 0; s < sizeof stages / sizeof *stages; s++) {
            char define[64];
            Error error;
            snprintf(define, sizeof define, "#define FIELD surface/%s.glsl\n", fields[k]);
            const unsigned program = program_create("surface", stages[s], define, &error);
            assert_true(program != 0);
            glDeleteProgram(program);
        }
}

static void every_form_is_made(void **state)
{
    (void)state;
    WorldDef def = pool_def("compute");
    glDisable(GL_DEBUG_OUTPUT);
    texts_only = true;
    mueller_lives("compute");
    mueller_lives("fragment");
    mueller_has_more_on_compute();
    wcsph_lives();
    implicit_viscosity_lives();
    incompressible_lives("dfsph");
    incompressible_lives("pbf");
    draw_views(&def, false);
    with_a_ball(def.solids, &def.solid_count);
    draw_views(&def, true);
    add_fluids(&def);
    draw_views(&def, true);
    surfaces_are_walked_on();
    texts_only = false;
    gl_context_begin(); /* errors begin anew: there were no programs */
}

static void worlds_live(void **state)
{
    (void)state;
    WorldDef def = pool_def("compute");
    worlds_only = true;
    with_a_ball(def.solids, &def.solid_count);
    add_flow(&def);
    live(&def);
    set_name(def.method, "wcsph");
    def.dt = 0.0005;
    live(&def); /* without diffusion */
    wcsph_def(&def)->delta_sph = wcsph_def(&def)->shifting = 0.1;
    def.reproducible = true;
    live(&def);
    set_name(def.method, "dfsph");
    live(&def);
    set_name(def.method, "pbf");
    live(&def);
    toy_lives();
    worlds_only = false;
    assert_int_equal(unbound, 0);
    printf("worlds have up to %d storage blocks in a compute shader, %d bindings\n", most.compute_blocks,
           most.bindings);
    assert_true(most.compute_blocks == 14 && most.bindings == 16);
}

static void views_draw(void **state)
{
    (void)state;
    WorldDef def = pool_def("compute");
    most = (GlLimits){0};
    draw_views(&def, false);
    add_fluids(&def);
    draw_views(&def, false);
    assert_views_have_what_they_ask_for();
}

static void blocks_and_barriers_are_right(void **state)
{
    (void)state;
    printf("%d dispatches, %d commands that read or write what they may have written\n", dispatches,
           commands);
    assert_true(dispatches > 200 && commands > 200);
    assert_int_equal(violations, 0);
}

static void every_source_is_glsl(void **state)
{
    (void)state;
    char command[3 * SCRATCH_PATH];
    if (system("command -v glslangValidator > /dev/null") != 0) {
        printf("skipped: no glslangValidator; it is in Debian's glslang-tools\n");
        skip();
    }
    snprintf(command, sizeof command, "glslangValidator '%s'/* > '%s.log' 2>&1 || { cat '%s.log'; false; }",
             folder, folder, folder);
    printf("%zu sources\n", sources);
    assert_true(sources > 150);
    assert_int_equal(system(command), 0);
}

static int variants_setup(void **state)
{
    if (compare_setup(state) != 0)
        return 1;
    scratch_folder(folder);
    watch_entries();
    return 0;
}

static int variants_teardown(void **state)
{
    return context_teardown(state);
}

int main(void)
{
    toy_method_add();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(every_form_is_made, no_gl_errors),
        cmocka_unit_test_teardown(worlds_live, no_gl_errors),
        cmocka_unit_test_teardown(views_draw, no_gl_errors),
        cmocka_unit_test(blocks_and_barriers_are_right),
        cmocka_unit_test(every_source_is_glsl),
    };
    return cmocka_run_group_tests_name("gl.variants", tests, variants_setup, variants_teardown);
}

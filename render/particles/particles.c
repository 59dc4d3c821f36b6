#include "render/particles/particles.h"

#include "shaders/shared/bindings.h"
#include "shaders/shared/shadow_maps.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>

void work_buffer_remake(unsigned *buffer, size_t size, const char *label)
{
    glDeleteBuffers(1, buffer);
    glCreateBuffers(1, buffer);
    glObjectLabel(GL_BUFFER, *buffer, -1, label);
    glNamedBufferStorage(*buffer, (GLsizeiptr)size, NULL, 0);
}

bool work_buffer_try(unsigned *buffer, size_t size, const char *label)
{
    gl_debug_errors(); /* drops earlier errors: the query below is for this buffer */
    work_buffer_remake(buffer, size, label);
    const bool none = gl_errors_take(GL_OUT_OF_MEMORY) > 0;
    if (none) {
        glDeleteBuffers(1, buffer);
        *buffer = 0;
    }
    return !none;
}

size_t work_capacity(size_t capacity, size_t count)
{
    const size_t more = capacity + capacity / 2;
    return count > more ? count : more;
}

void work_dispatch(size_t groups)
{
    enum { ROW = 32768 };
    const size_t rows = (groups + ROW - 1) / ROW;
    glDispatchCompute((GLuint)(rows > 1 ? ROW : groups), (GLuint)rows, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void work_run(size_t invocations)
{
    work_dispatch((invocations + 63) / 64);
}

static size_t common_divisor(size_t a, size_t b)
{
    return b ? common_divisor(b, a % b) : a;
}

/* A step near the golden section of the number of groups: at any time the finished groups are spread
   evenly over all. The products stay below 2^32. */
static size_t scatter_step(size_t groups)
{
    size_t step = groups < 65536 ? groups * 618 / 1000 + 1 : 1;
    while (common_divisor(step, groups) > 1)
        step++;
    return step;
}

void work_run_scattered(size_t invocations)
{
    const size_t groups = (invocations + 63) / 64;
    glUniform1ui(SCATTER_STEP_AT, (GLuint)scatter_step(groups));
    work_dispatch(groups);
}

/* Each block that a program declares gets a buffer, even if the shader does not read the block: an unbound
   block makes some drivers spoil other blocks. Positions replace a missing attribute. */
static void bind_attributes(GLuint first, int count, const ParticleAttribute *const attributes[],
                            const ParticleBuffers *particles)
{
    enum { MOST = 3 };
    GLuint buffers[MOST];
    GLintptr offsets[MOST];
    GLsizeiptr sizes[MOST];
    if (!particles->position.buffer || particles->count == 0)
        return;
    for (int i = 0; i < count; i++) {
        const ParticleAttribute *bound = attributes[i]->buffer ? attributes[i] : &particles->position;
        buffers[i] = bound->buffer;
        offsets[i] = (GLintptr)bound->offset;
        sizes[i] = (GLsizeiptr)(particles->count * bound->stride);
    }
    glBindBuffersRange(GL_SHADER_STORAGE_BUFFER, first, count, buffers, offsets, sizes);
}

_Static_assert(SCALARS_STORAGE == POSITIONS_STORAGE + 1 && FLUIDS_STORAGE == POSITIONS_STORAGE + 2,
               "bound by one call");
_Static_assert(SCALAR_STRIDE_AT == POSITION_STRIDE_AT + 1 && FLUID_STRIDE_AT == POSITION_STRIDE_AT + 2,
               "set by one call");

void particle_bind(unsigned program, const ParticleBuffers *particles, Scalar scalar)
{
    const ParticleAttribute *of[] = {&particles->position, &particles->scalar[scalar], &particles->fluid};
    GLuint strides[3];
    for (int i = 0; i < 3; i++)
        strides[i] = (GLuint)(of[i]->stride / 4);
    bind_attributes(POSITIONS_STORAGE, 3, of, particles);
    glProgramUniform1uiv(program, POSITION_STRIDE_AT, 3, strides);
}

const ParticleAttribute *particle_color_attribute(const ParticleBuffers *particles, Scalar color_by)
{
    return color_by == SCALAR_FLUID ? &particles->fluid : &particles->scalar[color_by];
}

unsigned particle_bind_one(unsigned binding, const ParticleAttribute *attribute, size_t count,
                           unsigned stand_in)
{
    if (attribute->buffer)
        glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, attribute->buffer, (GLintptr)attribute->offset,
                          (GLsizeiptr)(count * attribute->stride));
    else
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, stand_in);
    return attribute->buffer ? (unsigned)(attribute->stride / 4) : 0;
}

bool fluid_numbers_create(FluidNumbers *numbers, Error *error)
{
    *numbers = (FluidNumbers){
        .program = program_create("fluid numbers", (const char *const[]){"render/fluid_numbers.comp", NULL},
                                  NULL, error)};
    return numbers->program != 0;
}

void fluid_numbers_destroy(FluidNumbers *numbers)
{
    glDeleteProgram(numbers->program);
    glDeleteBuffers(FLUID_PARTS, numbers->buffer);
    *numbers = (FluidNumbers){0};
}

static void reserve_numbers(FluidNumbers *numbers, int part, size_t count)
{
    size_t *capacity = &numbers->capacity[part];
    if (count <= *capacity)
        return;
    *capacity = work_capacity(*capacity, count);
    work_buffer_remake(&numbers->buffer[part], *capacity * sizeof(GLfloat), "fluid numbers");
}

_Static_assert(FLUID_VALUES_MAX == FLUIDS_MAX, "the shader knows all fluids");

ParticleBuffers fluid_numbers_add(FluidNumbers *numbers, int part, const float of_fluid[FLUIDS_MAX],
                                  const ParticleBuffers *particles)
{
    ParticleBuffers with = *particles;
    if (!particles->fluid.buffer || !particles->count)
        return with;
    reserve_numbers(numbers, part, particles->count);
    glUseProgram(numbers->program);
    particle_bind(numbers->program, particles, SCALAR_FLUID);
    glUniform1ui(CURVE_PARTICLES_AT, (GLuint)particles->count);
    glUniform1fv(FLUID_VALUES_AT, FLUIDS_MAX, of_fluid);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHAPES_STORAGE, numbers->buffer[part]);
    work_run(particles->count);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                    GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
    with.scalar[SCALAR_FLUID] = (ParticleAttribute){numbers->buffer[part], 0, sizeof(GLfloat)};
    return with;
}

void particles_middle(const ParticleBuffers *particles, double middle[3])
{
    enum { PART = 4096 }; /* particles per read */
    const ParticleAttribute *from = &particles->position;
    const size_t count = from->buffer ? particles->count : 0;
    float at[4 * PART];
    double sum[3] = {0};
    size_t known = 0;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    for (size_t first = 0, part; first < count; first += part) {
        part = count - first < PART ? count - first : PART;
        glGetNamedBufferSubData(from->buffer, (GLintptr)(from->offset + first * from->stride),
                                (GLsizeiptr)(part * from->stride), at);
        for (size_t i = 0; i < part; i++) {
            const float *x = at + 4 * i;
            const bool finite = isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]);
            known += finite;
            for (int k = 0; finite && k < 3; k++)
                sum[k] += (double)x[k];
        }
    }
    for (int k = 0; k < 3; k++)
        middle[k] = known > 0 ? sum[k] / (double)known : k == 1 ? 0.5 * particles->box_size[1] : 0;
}

void particle_bind_ids(unsigned program, const ParticleBuffers *particles)
{
    const ParticleAttribute *ids = &particles->scalar[SCALAR_ID];
    bind_attributes(IDS_STORAGE, 1, &ids, particles);
    glProgramUniform1ui(program, ID_STRIDE_AT, (GLuint)(ids->buffer ? ids->stride / 4 : 0));
}

float point_sprite_limit(void)
{
    GLfloat range[2] = {0};
    if (gl_renderer_is_software())
        glGetFloatv(GL_POINT_SIZE_RANGE, range);
    return range[1];
}

void quad_indices_create(QuadIndices *indices)
{
    *indices = (QuadIndices){0};
    glCreateVertexArrays(1, &indices->vertex_array);
    glObjectLabel(GL_VERTEX_ARRAY, indices->vertex_array, -1, "quads");
}

void quad_indices_destroy(QuadIndices *indices)
{
    glDeleteVertexArrays(1, &indices->vertex_array);
    glDeleteBuffers(1, &indices->buffer);
    *indices = (QuadIndices){0};
}

static void fill_quads(uint32_t *index, size_t count)
{
    static const uint32_t corners[6] = {0, 1, 2, 2, 1, 3};
    for (size_t i = 0; i < 6 * count; i++)
        index[i] = (uint32_t)(4 * (i / 6)) + corners[i % 6];
}

/* Makes the index buffer again for more particles. */
static void reserve_quads(QuadIndices *indices, size_t count)
{
    const GLsizeiptr size = (GLsizeiptr)(6 * count * sizeof(uint32_t));
    glDeleteBuffers(1, &indices->buffer);
    glCreateBuffers(1, &indices->buffer);
    glObjectLabel(GL_BUFFER, indices->buffer, -1, "quad indices");
    glNamedBufferStorage(indices->buffer, size, NULL, GL_MAP_WRITE_BIT);
    uint32_t *mapped = glMapNamedBufferRange(indices->buffer, 0, size, GL_MAP_WRITE_BIT);
    indices->capacity = mapped ? count : 0;
    if (mapped)
        fill_quads(mapped, count);
    glUnmapNamedBuffer(indices->buffer);
    glVertexArrayElementBuffer(indices->vertex_array, indices->buffer);
}

static bool prepare_quads(QuadIndices *indices, size_t count)
{
    if (count > indices->capacity)
        reserve_quads(indices, work_capacity(indices->capacity, count));
    glBindVertexArray(indices->vertex_array);
    return count && count <= indices->capacity;
}

void quad_indices_draw_indirect(QuadIndices *indices, size_t count, unsigned commands, size_t offset)
{
    if (!prepare_quads(indices, count))
        return;
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands);
    glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, (const char *)NULL + offset);
}

void quad_indices_draw(QuadIndices *indices, size_t count)
{
    if (!prepare_quads(indices, count))
        return;
    glDrawElements(GL_TRIANGLES, (GLsizei)(6 * count), GL_UNSIGNED_INT, NULL);
}

bool particle_clip_create(ParticleClip *half, Error *error)
{
    static const char *const stages[] = {"render/half.comp", NULL};
    half->program = program_create("half", stages, NULL, error);
    return half->program != 0;
}

void particle_clip_destroy(ParticleClip *half)
{
    glDeleteProgram(half->program);
    glDeleteBuffers(1, &half->positions);
    *half = (ParticleClip){0};
}

void particle_clip_run(ParticleClip *half, const ParticleBuffers *particles, const double normal[3],
                       double most, ParticleBuffers *out)
{
    *out = *particles;
    if (particles->count == 0)
        return;
    if (particles->count > half->capacity) {
        half->capacity = work_capacity(half->capacity, particles->count);
        work_buffer_remake(&half->positions, half->capacity * sizeof(float[4]), "half");
    }
    out->position = (ParticleAttribute){half->positions, 0, sizeof(float[4])};
    glUseProgram(half->program);
    particle_bind(half->program, particles, SCALAR_SPEED); /* no scalar is read */
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, HALF_STORAGE, half->positions);
    glUniform4f(HALF_PLANE_AT, (GLfloat)normal[0], (GLfloat)normal[1], (GLfloat)normal[2], (GLfloat)most);
    glUniform1ui(HALF_COUNT_AT, (GLuint)particles->count);
    work_run(particles->count);
}

bool shadow_caster_create(ShadowCaster *casting, const char *defines, Error *error)
{
    static const char *const stages[] = {"render/ball_shadow.comp", NULL};
    *casting = (ShadowCaster){0};
    glCreateVertexArrays(1, &casting->screen);
    work_buffer_remake(&casting->texels, sizeof(GLuint) * SHADOW_MAP_TEXELS * SHADOW_MAP_TEXELS, "cast");
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &casting->rows);
    glTextureBuffer(casting->rows, GL_RGBA32UI, casting->texels);
    casting->write = program_create("cast", stages, defines, error);
    if (casting->write)
        casting->show = program_create_pair("cast map", "common/screen.vert", "render/cast.frag", error);
    return casting->show != 0;
}

void shadow_caster_destroy(ShadowCaster *casting)
{
    glDeleteProgram(casting->write);
    glDeleteProgram(casting->show);
    glDeleteTextures(1, &casting->rows);
    glDeleteBuffers(1, &casting->texels);
    glDeleteVertexArrays(1, &casting->screen);
    *casting = (ShadowCaster){0};
}

void shadow_caster_draw(const ShadowCaster *casting, const ParticleBuffers *particles)
{
    if (particles->count == 0)
        return;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                    GL_TEXTURE_FETCH_BARRIER_BIT);
    glClearNamedBufferData(casting->texels, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, CAST_STORAGE, casting->texels);
    glBindTextureUnit(CAST_UNIT, casting->rows);
    glUseProgram(casting->write);
    particle_bind(casting->write, particles, SCALAR_SPEED); /* no scalar is read */
    glUniform1ui(CASTERS_AT, (GLuint)particles->count);
    work_run_scattered(particles->count);
    glUseProgram(casting->show);
    glBindVertexArray(casting->screen);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

_Static_assert(CURVE_POINTS_MAX == CONTROL_POINTS_MAX, "the shader has room for all points");

const char *particle_curves_defines(const ViewDef *def)
{
    static const char *const lines[] = {"", "#define DROPS 1\n", "#define VEILED 1\n",
                                        "#define DROPS 1\n#define VEILED 1\n"};
    return lines[(def->size.by != 0) + 2 * (def->opacity.by != 0)];
}

static bool is_there(const ScalarCurve *curve, const ParticleBuffers *particles)
{
    return curve->by != 0 && particles->scalar[scalar_of_curve(curve)].buffer != 0;
}

double particle_curves_reach(const ViewDef *def, const ParticleBuffers *particles)
{
    return is_there(&def->size, particles) ? control_points_most(&def->size.curve) : 1;
}

static bool create_curve(ParticleCurve *curve, int by, const char *defines, Error *error)
{
    static const char *const stages[] = {"render/particle_curve.comp", NULL};
    if (by != 0)
        curve->program = program_create("particle curve", stages, defines, error);
    return by == 0 || curve->program != 0;
}

bool particle_curves_create(ParticleCurves *curves, const ViewDef *def, Error *error)
{
    *curves = (ParticleCurves){.size = {.program = 0}};
    return create_curve(&curves->size, def->size.by, NULL, error) &&
           create_curve(&curves->opacity, def->opacity.by, "#define VEILED 1\n", error);
}

static void destroy_curve(ParticleCurve *curve)
{
    glDeleteProgram(curve->program);
    glDeleteBuffers(1, &curve->values);
}

void particle_curves_destroy(ParticleCurves *curves)
{
    destroy_curve(&curves->size);
    destroy_curve(&curves->opacity);
    *curves = (ParticleCurves){.size = {.program = 0}};
}

static void reserve_curve(ParticleCurve *curve, size_t count, size_t floats)
{
    if (count <= curve->capacity)
        return;
    curve->capacity = work_capacity(curve->capacity, count);
    work_buffer_remake(&curve->values, curve->capacity * floats * sizeof(GLfloat), "particle curve");
}

void particle_curve_set(const ScalarCurve *said, const double range[2], double unit, bool there)
{
    GLfloat point[2 * CONTROL_POINTS_MAX] = {0};
    const ControlPoints *points = &said->curve;
    for (int k = 0; k < points->count; k++) {
        point[2 * k] = (GLfloat)points->x[k];
        point[2 * k + 1] = (GLfloat)(points->y[k] / unit);
    }
    glUniform1ui(CURVE_POINTS_AT, there ? (GLuint)points->count : 0);
    glUniform2fv(CURVE_POINT_AT, CONTROL_POINTS_MAX, point);
    glUniform2f(CURVE_RANGE_AT, (GLfloat)range[0], (GLfloat)(1 / (range[1] - range[0])));
}

void particle_curve_run(unsigned program, const ScalarCurve *said, const double range[2], double unit,
                        const ParticleBuffers *particles)
{
    glUseProgram(program);
    particle_bind(program, particles, scalar_of_curve(said));
    particle_curve_set(said, range, unit, is_there(said, particles));
    glUniform1ui(CURVE_PARTICLES_AT, (GLuint)particles->count);
    work_run(particles->count);
}

void particle_curves_make(ParticleCurves *curves, const ParticleBuffers *particles, const Frame *frame)
{
    const ViewDef *def = frame->def;
    if (particles->count == 0)
        return;
    if (curves->size.program) {
        reserve_curve(&curves->size, particles->count, 1);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHAPES_STORAGE, curves->size.values);
        particle_curve_run(curves->size.program, &def->size, frame->curves.size, 1, particles);
    }
    if (curves->opacity.program) {
        reserve_curve(&curves->opacity, particles->count, 2);
        particle_bind_ids(curves->opacity.program, particles);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, VEILS_STORAGE, curves->opacity.values);
        particle_curve_run(curves->opacity.program, &def->opacity, frame->curves.opacity, 1, particles);
    }
}

void particle_curves_bind(const ParticleCurves *curves)
{
    if (curves->size.values)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHAPES_STORAGE, curves->size.values);
    if (curves->opacity.values)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, VEILS_STORAGE, curves->opacity.values);
}

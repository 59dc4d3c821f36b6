#include "render/particles/particle_curves.h"

#include "render/particles/particle_bind.h"
#include "render/particles/work.h"
#include "shaders/shared/bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <math.h>

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

static bool create(ParticleCurve *curve, int by, const char *defines, Error *error)
{
    static const char *const stages[] = {"render/particle_curve.comp", NULL};
    if (by != 0)
        curve->program = program_create("particle curve", stages, defines, error);
    return by == 0 || curve->program != 0;
}

bool particle_curves_create(ParticleCurves *curves, const ViewDef *def, Error *error)
{
    *curves = (ParticleCurves){.size = {.program = 0}};
    return create(&curves->size, def->size.by, NULL, error) &&
           create(&curves->opacity, def->opacity.by, "#define VEILED 1\n", error);
}

static void destroy(ParticleCurve *curve)
{
    glDeleteProgram(curve->program);
    glDeleteBuffers(1, &curve->values);
}

void particle_curves_destroy(ParticleCurves *curves)
{
    destroy(&curves->size);
    destroy(&curves->opacity);
    *curves = (ParticleCurves){.size = {.program = 0}};
}

static void reserve(ParticleCurve *curve, size_t count, size_t floats)
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
        reserve(&curves->size, particles->count, 1);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHAPES_STORAGE, curves->size.values);
        particle_curve_run(curves->size.program, &def->size, frame->size_range, 1, particles);
    }
    if (curves->opacity.program) {
        reserve(&curves->opacity, particles->count, 2);
        particle_bind_ids(curves->opacity.program, particles);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, VEILS_STORAGE, curves->opacity.values);
        particle_curve_run(curves->opacity.program, &def->opacity, frame->opacity_range, 1, particles);
    }
}

void particle_curves_bind(const ParticleCurves *curves)
{
    if (curves->size.values)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHAPES_STORAGE, curves->size.values);
    if (curves->opacity.values)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, VEILS_STORAGE, curves->opacity.values);
}

/* Programs, and drawing of a pass. */
#include "sim/gpu/fragment/fragment.h"

#include "sim/box/box.h"
#include "sim/gpu/gl.h"

#include <assert.h>
#include <epoxy/gl.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Constants of a world as GLSL text, so that the compiler knows all values. Names as in
   shaders/sim/constant_block.h, so that wall_lift.glsl and images.glsl serve both backends. */

typedef struct SourceText {
    char *text;
    size_t size, used;
} SourceText;

static __attribute__((format(printf, 2, 3))) void put(SourceText *to, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    const int size = vsnprintf(to->text + to->used, to->size - to->used, format, values);
    va_end(values);
    if (size > 0 && (size_t)size < to->size - to->used)
        to->used += (size_t)size;
}

static void put_ints(SourceText *to, const char *name, int count, const int *values)
{
    put(to, "const ivec%d %s = ivec%d(", count, name, count);
    for (int k = 0; k < count; k++)
        put(to, "%d%s", values[k], k + 1 < count ? ", " : ");\n");
}

/* Ten digits reproduce a float exactly. */
static void put_float(SourceText *to, const char *name, float value)
{
    put(to, "const float %s = %.9e;\n", name, (double)value);
}

/* Terms not named by the scene are not compiled. */
static void put_terms(SourceText *to, const Constants *s)
{
#define X(NAME, name, unit) put(to, "#define SCALAR_" #NAME " %d\n", SCALAR_##NAME);
    STATE_SCALAR_LIST(X)
    BACKEND_SCALAR_LIST(X)
    X(STATE_COUNT, , )
#undef X
    put(to, "#define FLUIDS %d\n", s->fluid_count);
    put(to, "%s%s", s->viscous ? "#define VISCOUS 1\n" : "",
        s->negative_pressure ? "#define NEGATIVE_PRESSURE 1\n" : "");
    for (const ShaderTerm *own = s->method->terms; own && own->name; own++)
        if (own->needed(s))
            put(to, "#define %s 1\n", own->name);
    if (s->method->energy_shader)
        put(to, "#define ENERGY_OF_METHOD sim/%s.glsl\n", s->method->energy_shader);
}

static void put_kernel(SourceText *to, const Constants *s)
{
    put_float(to, "support", s->support_radius);
    put_float(to, "inverse_support", 1 / s->support_radius);
    put_float(to, "rest_number_density", s->rest_number_density);
    put_float(to, "spacing", s->spacing);
    put_float(to, "kernel_scale", s->kernel_scale);
    put_float(to, "pressure_scale", s->pressure_scale);
    put_float(to, "viscosity_scale", s->viscosity_scale);
    put_float(to, "stiffness_scale", s->stiffness_scale);
    put_float(to, "unit_volume", (float)s->unit_volume);
}

void fragment_constants(const Fragment *f, char text[FRAGMENT_CONSTANTS_MAX])
{
    const Constants *s = f->constants;
    SourceText to = {text, FRAGMENT_CONSTANTS_MAX, 0};
    put_terms(&to, s);
    put(&to, "const int particle_count = %zu, particle_bits = %d;\n", f->count, f->bits);
    put(&to, "const int bucket_bits = %d, bucket_height = %d, bucket_layers = %d;\n", f->bucket_bits,
        f->bucket_height, f->layers);
    put_kernel(&to, s);
    put_ints(&to, "first_cell", 3, s->cells.first);
    put_ints(&to, "grid_size", 3, s->cells.size);
    put(&to, "const int dimensions = %d, first_row = %d, last_row = %d;\n", s->dimensions, s->first_row,
        s->last_row);
    put(&to, "uniform vec3 half_size;\n"); /* the box may change while programs stay */
    put_float(&to, "wall_lift", s->lift.scale);
}

/* Stages of a step, each a pass over all particles. */

enum { FIRST_UNIT = 16 }; /* the views use lower units; GL 4.5 has 80 over all stages */

static const struct {
    const char *vertex, *next, *defines;
} passes[] = {
#define X(NAME, vertex, next, defines) {vertex, next, defines},
    FRAGMENT_PASSES(X)
#undef X
};

static const char *const samplers[] = {
#define X(NAME, name) name,
    FRAGMENT_SAMPLERS(X)
#undef X
};

static bool shader_of(const Pass *pass, char path[64])
{
    snprintf(path, 64, "sim/%s.frag", pass->shader ? pass->shader : "");
    return pass->shader != NULL;
}

bool fragment_has(const Method *method)
{
    int of_stage[STAGE_COUNT] = {0};
    char path[64];
    for (const Pass *const *pass = method->passes; *pass; pass++)
        if (!shader_of(*pass, path) || !shader_source_has(path) || of_stage[(*pass)->stage]++ > 0)
            return false;
    return of_stage[STAGE_DENSITY] == 1 && of_stage[STAGE_FORCE] == 1;
}

/* The shader after the vertex shader of a pass: the table's shader, or the method's for the stage. */
static void next_shader(const Method *method, FragmentPass pass, char path[64])
{
    const Stage stage = pass == FRAGMENT_DENSITY ? STAGE_DENSITY : STAGE_FORCE;
    const Pass *const *own = method->passes;
    if (passes[pass].next) {
        snprintf(path, 64, "sim/%s", passes[pass].next);
        return;
    }
    while ((*own)->stage != stage)
        own++;
    shader_of(*own, path);
}

static unsigned pass_create(const Fragment *f, FragmentPass pass, const char *constant_lines, Error *error)
{
    char vertex[64], next[64], text[4096];
    snprintf(vertex, sizeof vertex, "sim/%s", passes[pass].vertex);
    next_shader(f->constants->method, pass, next);
    snprintf(text, sizeof text, "%s%s", passes[pass].defines, constant_lines);
    const char *const stages[] = {vertex, next, NULL};
    const bool captures = pass == FRAGMENT_WAITING || pass == FRAGMENT_ORDER;
    const char *label = next + strlen("sim/");
    const unsigned program = captures ? program_create_captured(label, stages, text, "waiting", error)
                                      : program_create(label, stages, text, error);
    for (int s = 0; program && s < FRAGMENT_SAMPLER_COUNT; s++) {
        const GLint at = glGetUniformLocation(program, samplers[s]);
        if (at >= 0)
            glProgramUniform1i(program, at, FIRST_UNIT + s);
    }
    return program;
}

int fragment_uniform(const Fragment *f, FragmentPass pass, FragmentUniform uniform)
{
    return f->uniform[pass][uniform];
}

static void find_uniforms(Fragment *f, int pass)
{
    static const char *const names[] = {
#define X(name) #name,
        FRAGMENT_UNIFORMS(X)
#undef X
    };
    for (int k = 0; k < FRAGMENT_UNIFORM_COUNT; k++)
        f->uniform[pass][k] = f->program[pass] ? glGetUniformLocation(f->program[pass], names[k]) : -1;
}

void fragment_set_fluids(const Fragment *f)
{
    const Constants *s = f->constants;
    float fluids[FLUIDS_MAX][4];
    for (int k = 0; k < s->fluid_count; k++)
        memcpy(fluids[k], (const float[]){s->mass[k], s->density[k], s->stiffness[k], s->viscosity[k]},
               sizeof fluids[k]);
    for (int p = 0; p < FRAGMENT_PASS_COUNT; p++) {
        const GLint at = f->program[p] ? fragment_uniform(f, (FragmentPass)p, FRAGMENT_fluid_numbers) : -1;
        if (at >= 0)
            glProgramUniform4fv(f->program[p], at, s->fluid_count, fluids[0]);
        if (f->program[p])
            fragment_set3(f, (FragmentPass)p, FRAGMENT_half_size, s->walls.half_size);
    }
}

static bool is_gauge(int pass)
{
    return pass == FRAGMENT_GAUGE_FIRST || pass == FRAGMENT_GAUGE_MORE || pass == FRAGMENT_ENERGY_FIRST;
}

bool fragment_gauge_programs(Fragment *f, Error *error)
{
    for (int p = 0; p < FRAGMENT_PASS_COUNT; p++) {
        if (!is_gauge(p) || f->program[p])
            continue;
        f->program[p] = pass_create(f, (FragmentPass)p, f->constant_lines, error);
        find_uniforms(f, p);
        if (!f->program[p])
            return false;
    }
    fragment_set_fluids(f);
    return true;
}

bool fragment_programs_create(Fragment *f, Error *error)
{
    unsigned made[FRAGMENT_PASS_COUNT] = {0};
    char constant_lines[FRAGMENT_CONSTANTS_MAX];
    fragment_constants(f, constant_lines);
    for (int p = 0; p < FRAGMENT_PASS_COUNT; p++) {
        if (is_gauge(p) && !f->program[p]) /* not requested */
            continue;
        made[p] = pass_create(f, (FragmentPass)p, constant_lines, error);
        if (made[p])
            continue;
        while (p-- > 0)
            glDeleteProgram(made[p]);
        return false;
    }
    for (int p = 0; p < FRAGMENT_PASS_COUNT; p++) {
        glDeleteProgram(f->program[p]);
        f->program[p] = made[p];
        find_uniforms(f, p);
    }
    memcpy(f->constant_lines, constant_lines, sizeof constant_lines);
    fragment_set_fluids(f);
    return true;
}

void fragment_set3(const Fragment *f, FragmentPass pass, FragmentUniform uniform, const float value[3])
{
    glProgramUniform3fv(f->program[pass], fragment_uniform(f, pass, uniform), 1, value);
}

void fragment_set1(const Fragment *f, FragmentPass pass, FragmentUniform uniform, float value)
{
    glProgramUniform1f(f->program[pass], fragment_uniform(f, pass, uniform), value);
}

void fragment_sample(FragmentSampler sampler, unsigned texture)
{
    glBindTextureUnit((GLuint)(FIRST_UNIT + (int)sampler), texture);
}

static unsigned framebuffer_create(const unsigned *targets, int count)
{
    static const GLenum attachments[3] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
    unsigned framebuffer;
    glCreateFramebuffers(1, &framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, framebuffer, -1, "solver pass");
    assert(count <= 3);
    for (int k = 0; k < count; k++)
        glNamedFramebufferTexture(framebuffer, attachments[k], targets[k], 0);
    glNamedFramebufferDrawBuffers(framebuffer, count, attachments);
    return framebuffer;
}

/* The framebuffer of the targets: a driver checks new attachments. */
static unsigned framebuffer_of(Fragment *f, const unsigned *targets, int count)
{
    unsigned set[3] = {0};
    memcpy(set, targets, (size_t)count * sizeof *targets);
    for (int i = 0; i < f->framebuffer_count; i++)
        if (memcmp(f->framebuffers[i].targets, set, sizeof set) == 0)
            return f->framebuffers[i].name;
    const int at = f->framebuffer_count < FRAGMENT_FRAMEBUFFERS_MOST ? f->framebuffer_count++ : 0;
    glDeleteFramebuffers(1, &f->framebuffers[at].name);
    memcpy(f->framebuffers[at].targets, set, sizeof set);
    return f->framebuffers[at].name = framebuffer_create(targets, count);
}

void fragment_target(Fragment *f, const unsigned *targets, int count, int width, int height)
{
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_of(f, targets, count));
    glViewport(0, 0, width, height);
    glBindVertexArray(f->vertex_array);
}

void fragment_draw(Fragment *f, FragmentPass pass, const unsigned *targets, int count, int width, int height)
{
    fragment_target(f, targets, count, width, height);
    glUseProgram(f->program[pass]);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void fragment_pack(unsigned texture, unsigned format, unsigned buffer, size_t at, size_t bytes)
{
    const GLenum type = format == GL_RGBA ? GL_FLOAT : GL_UNSIGNED_INT;
    GLint before;
    glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &before);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer);
    glGetTextureImage(texture, 0, format, type, (GLsizei)bytes, (void *)at);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, (GLuint)before);
}

void fragment_swap(unsigned pair[2])
{
    const unsigned before = pair[0];
    pair[0] = pair[1];
    pair[1] = before;
}

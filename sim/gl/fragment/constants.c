/* Constants of a world as GLSL text, so that the compiler knows all values. Names as in
   shaders/sim/constant_block.h, so that wall_lift.glsl and images.glsl serve both backends. */
#include "sim/gl/fragment/fragment.h"

#include "sim/box/wall_lift.h"

#include <stdarg.h>
#include <stdio.h>

typedef struct Text {
    char *text;
    size_t size, used;
} Text;

static __attribute__((format(printf, 2, 3))) void put(Text *to, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    const int size = vsnprintf(to->text + to->used, to->size - to->used, format, values);
    va_end(values);
    if (size > 0 && (size_t)size < to->size - to->used)
        to->used += (size_t)size;
}

static void put_ints(Text *to, const char *name, int count, const int *values)
{
    put(to, "const ivec%d %s = ivec%d(", count, name, count);
    for (int k = 0; k < count; k++)
        put(to, "%d%s", values[k], k + 1 < count ? ", " : ");\n");
}

/* Ten digits reproduce a float exactly. */
static void put_float(Text *to, const char *name, float value)
{
    put(to, "const float %s = %.9e;\n", name, (double)value);
}

/* Terms not named by the scene are not compiled. */
static void put_terms(Text *to, const Constants *s)
{
#define X(NAME, name, unit) put(to, "#define SCALAR_" #NAME " %d\n", SCALAR_##NAME);
    STATE_SCALAR_LIST(X)
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

static void put_kernel(Text *to, const Constants *s)
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
    Text to = {text, FRAGMENT_CONSTANTS_MAX, 0};
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
    put_float(&to, "wall_lift",
              wall_lift_of(&s->lattice, (double)s->spacing, (double)s->support_radius).scale);
}

/* The order of work groups and invocations is up to the driver: a world in reproducible mode has the same
   bits in any order. The test gives the solver's shaders permuted numbers. */
#include "sim/methods/wcsph/wcsph.h"
#include "tests/gl/compare.h"
#include "tests/lists.h"

#include <epoxy/gl.h>

static PFNGLSHADERSOURCEPROC set_source;
static const char *order; /* position g among n things; NULL: unchanged */
static int changed;

static const char *const orders[] = {
    "uint nth(uint g, uint n) { return n - 1u - g; }\n",
    "uint nth(uint g, uint n) { return n % 7919u == 0u ? g : (g * 7919u + 5u) % n; }\n",
};

static const char permuted[] =
    "uvec3 groups_taken() {\n"
    "    uint along = gl_NumWorkGroups.x, g = nth(gl_WorkGroupID.y * along + gl_WorkGroupID.x, along * gl_NumWorkGroups.y);\n"
    "    return uvec3(g % along, g / along, 0u);\n"
    "}\n"
    "uvec3 permuted_invocation() {\n"
    "    return groups_taken() * gl_WorkGroupSize + uvec3(nth(gl_LocalInvocationID.x, gl_WorkGroupSize.x), 0u, 0u);\n"
    "}\n";

/* Text in a solver's shader, and the replacement of the same length. */
static void replace(char *text, const char *what, const char *by)
{
    assert_int_equal(strlen(what), strlen(by));
    for (char *at = strstr(text, what); at; at = strstr(at, what)) {
        memcpy(at, by, strlen(by));
        changed++;
    }
}

/* The sizes of work groups are known after the declaring line. */
static char *with_order(const char *text)
{
    const char *declared = strstr(text, ") in;\n");
    if (!order || !declared)
        return NULL;
    const size_t before = (size_t)(declared - text) + strlen(") in;\n");
    char *rest = strdup(text + before), *whole = malloc(strlen(text) + strlen(order) + sizeof permuted);
    replace(rest, "gl_GlobalInvocationID", "permuted_invocation()");
    replace(rest, "gl_WorkGroupID", "groups_taken()");
    sprintf(whole, "%.*s%s%s%s", (int)before, text, order, permuted, rest);
    free(rest);
    return whole;
}

static void APIENTRY source_in_order(GLuint shader, GLsizei count, const GLchar *const *text,
                                     const GLint *length)
{
    char *other = with_order(text[0]);
    const GLchar *const one = other ? other : text[0];
    set_source(shader, count, &one, length);
    free(other);
}

static void APIENTRY refuse(GLuint program, GLenum format, const void *binary, GLsizei size)
{
    (void)program, (void)format, (void)binary, (void)size;
}

static WorldDef splash_def(const char *method)
{
    WorldDef def = fixture_def(1.2, 0.9, 0.6);
    snprintf(def.backend, sizeof def.backend, "compute");
    snprintf(def.method, sizeof def.method, "%s", method);
    def.spacing = 0.08;
    def.sound_speed = 20;
    def.dt = 0.002;
    def.most = 3000;
    def.fluids[0].viscosity = 1;
    wcsph_def(&def)->delta_sph = wcsph_def(&def)->shifting = strcmp(method, "wcsph") == 0 ? 0.1 : 0;
    fixture_block(&def, 0, -0.6, 0, -0.3, 0.1, 0.5, 0.3);
    def.solids[def.solid_count++] = (SolidDef){
        .kind = SOLID_SPHERE, .centre = {0.3, 0.2, 0}, .radius = 0.15, .axis = {0, 1, 0}, .slip = SLIP_NONE};
    add_solid_motion(&def.solids[0],
                     (Motion){.kind = MOTION_SHAKE, .axis = {0, 1, 0}, .amplitude = 0.05, .frequency = 5});
    add_emit(&def.fluids[0],
             (Emit){.centre = {-0.2, 0.8, 0}, .direction = {0.3, -1, 0}, .radius = 0.13, .speed = 2});
    add_drain(&def, (Fill){.kind = FILL_BLOCK, .min = {-0.6, 0, -0.3}, .max = {-0.4, 0.1, 0.3}});
    return def;
}

static uint64_t hash_in(const char *as, const WorldDef *def)
{
    order = as;
    World *world = fixture_world(def);
    substeps(world, 10);
    const uint64_t hash = world_hash(world);
    assert_true(info_of(world).emitted > 5 && info_of(world).drained > 10);
    world_destroy(world);
    return hash;
}

static void any_order_gives_the_same_bits(void **state)
{
    (void)state;
    set_source = epoxy_glShaderSource;
    PFNGLPROGRAMBINARYPROC take_binary = epoxy_glProgramBinary;
    epoxy_glShaderSource = source_in_order;
    epoxy_glProgramBinary = refuse; /* else equal sources would be taken as they were compiled first */
    WorldDef def = splash_def("wcsph");
    assert_true(hash_in(NULL, &def) == hash_in(orders[1], &def));
    def = splash_def("mueller");
    assert_true(hash_in(NULL, &def) == hash_in(orders[0], &def));
    def.reproducible = false; /* where the order does tell */
    assert_true(hash_in(orders[0], &def) != hash_in(orders[1], &def));
    assert_true(changed > 100);
    epoxy_glShaderSource = set_source;
    epoxy_glProgramBinary = take_binary;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(any_order_gives_the_same_bits, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.order", tests, compare_setup, context_teardown);
}

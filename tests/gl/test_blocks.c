/* Blocks shared by C and GLSL: each member's offset in C is the driver's. */
#include "tests/gl/compare.h"
#include "tests/gl/solver_blocks.h"

#include "shaders/shared/frame_block.h"
#include "shaders/shared/plane_block.h"
#include "shaders/shared/solid_block.h"
#include "shaders/volume/raycast_block.h"
#include "shaders/volume/solid_shares_block.h"
#include "shaders/volume/volume_block.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <stddef.h>

typedef struct Member {
    const char *name;
    size_t offset;
} Member;

typedef struct Block {
    const char *path; /* of the header, below shaders/ */
    const char *name;
    size_t size;
    const Member *members; /* all; of an array the first element */
    size_t count;
} Block;

#define MEMBER(block, member)                                                                                \
    {                                                                                                        \
#member, offsetof(block, member)                                                                     \
    }
#define BLOCK(path, name, ...)                                                                               \
    {                                                                                                        \
        path, #name, sizeof(name), (const Member[]){__VA_ARGS__},                                            \
            sizeof((const Member[]){__VA_ARGS__}) / sizeof(Member)                                           \
    }

#define FRAME(member)   MEMBER(FrameBlock, member)
#define RAYCAST(member) MEMBER(RaycastBlock, member)
#define VOLUME(member)  MEMBER(VolumeBlock, member)
#define SOLID(member)   MEMBER(SolidBlock, member)
#define SHARES(member)  MEMBER(SolidSharesBlock, member)
#define SLICE(member)   MEMBER(PlaneBlock, member)

static const Block blocks[] = {
    SOLVER_BLOCKS,
    BLOCK("shared/frame_block.h", FrameBlock, FRAME(box_to_eye), FRAME(box_to_light), FRAME(eye_to_light),
          FRAME(world_to_light), FRAME(eye_to_world), FRAME(view_tangent), FRAME(view_centre),
          FRAME(near_plane), FRAME(light_depth), FRAME(picture_size), FRAME(pixel_size), FRAME(light_in_eye),
          FRAME(shading), FRAME(up_in_eye), FRAME(shadow_radius), FRAME(light_color), FRAME(light_radius),
          FRAME(sky_color), FRAME(particle_radius), FRAME(ground_color), FRAME(particle_spacing),
          FRAME(background), FRAME(range_low), FRAME(box_size), FRAME(range_scale), FRAME(floor_center),
          FRAME(floor_height), FRAME(floor_radius), FRAME(floor_map_corner), FRAME(floor_map_size),
          FRAME(edge_color), FRAME(fluid_color[0]), FRAME(by_fluid), FRAME(walled), FRAME(fluid_clear),
          FRAME(glass), FRAME(fineness), FRAME(shadow_spread), FRAME(light_in_world)),
    BLOCK("shared/solid_block.h", SolidBlock, SOLID(solids[0].to_eye), SOLID(solids[0].to_light),
          SOLID(solids[0].to_box), SOLID(solids[0].color), SOLID(solids[0].size), SOLID(solids[0].cut),
          SOLID(solids[0].across), SOLID(solids[1].to_eye), SOLID(solids[15].across)),
    BLOCK("volume/solid_shares_block.h", SolidSharesBlock, SHARES(shares[0].from_cells),
          SHARES(shares[0].nodes), SHARES(shares[0].first), SHARES(shares[1].from_cells),
          SHARES(shares[15].first), SHARES(shared_first), SHARES(share_count), SHARES(shared_cells),
          SHARES(least_free)),
    BLOCK("volume/raycast_block.h", RaycastBlock, RAYCAST(eye_to_volume), RAYCAST(volume_to_eye),
          RAYCAST(volume_cells), RAYCAST(cell_size), RAYCAST(brick_count), RAYCAST(brick_side),
          RAYCAST(wall_low), RAYCAST(brick_least), RAYCAST(wall_high), RAYCAST(surface_level),
          RAYCAST(field_low), RAYCAST(step_length), RAYCAST(field_high), RAYCAST(far_step),
          RAYCAST(near_start), RAYCAST(ramp_begin), RAYCAST(ramp_scale), RAYCAST(extinction),
          RAYCAST(skin_depth), RAYCAST(opacity_low), RAYCAST(opacity_scale), RAYCAST(enough_light),
          RAYCAST(jitter)),
    BLOCK("volume/volume_block.h", VolumeBlock, VOLUME(volume_corner), VOLUME(cells_per_m),
          VOLUME(volume_low), VOLUME(kernel_radius), VOLUME(volume_high), VOLUME(radius2_inverse),
          VOLUME(volume_size), VOLUME(particle_count), VOLUME(list_size), VOLUME(list_scale),
          VOLUME(kernel_peak)),
    BLOCK("shared/plane_block.h", PlaneBlock, SLICE(plane_corner), SLICE(plane_along), SLICE(plane_up),
          SLICE(plane_normal), SLICE(plane_side), SLICE(plane_samples), SLICE(plane_support),
          SLICE(plane_peak)),
};

/* A block of std140 or std430 is active, with all members, where no shader reads any of them. */
static GLuint program_with(const char *path)
{
    static const char end[] = "layout(local_size_x = 1) in;\nvoid main() {}\n";
    ShaderSource source;
    Error error = {0};
    GLint linked = GL_FALSE;
    if (!shader_source_load(&source, path, NULL, &error))
        fail_msg("%s", error.message);
    const char *texts[] = {source.text, end};
    const GLuint shader = glCreateShader(GL_COMPUTE_SHADER), program = glCreateProgram();
    glShaderSource(shader, 2, texts, NULL);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    glDeleteShader(shader);
    shader_source_free(&source);
    if (!linked)
        fail_msg("%s does not stand alone", path);
    return program;
}

static GLint ask(GLuint program, GLenum interface, GLuint resource, GLenum what)
{
    GLint value = -1;
    glGetProgramResourceiv(program, interface, resource, 1, &what, 1, NULL, &value);
    return value;
}

/* An array's later elements follow from its first, and from the size of the whole. */
static bool is_later_element(const char *name)
{
    const char *bracket = strchr(name, '[');
    return bracket && strncmp(bracket, "[0]", 3) != 0;
}

static const Member *find_member(const Block *block, const char *name)
{
    for (size_t i = 0; i < block->count; i++)
        if (strcmp(block->members[i].name, name) == 0)
            return &block->members[i];
    return NULL;
}

/* Of a uniform block, or of a storage block. */
typedef struct Interface {
    GLenum block, member;
} Interface;

/* The number of the table's members known to the driver; all further members of the driver are errors. */
static size_t compare_members(const Block *block, GLuint program, Interface interface, GLuint resource)
{
    enum { VARIABLES_MAX = 256 };
    const GLenum what = GL_ACTIVE_VARIABLES;
    const GLint count = ask(program, interface.block, resource, GL_NUM_ACTIVE_VARIABLES);
    GLint variables[VARIABLES_MAX];
    size_t found = 0;
    assert_in_range(count, 1, VARIABLES_MAX);
    glGetProgramResourceiv(program, interface.block, resource, 1, &what, count, NULL, variables);
    for (GLint i = 0; i < count; i++) {
        char name[64] = "";
        glGetProgramResourceName(program, interface.member, (GLuint)variables[i], sizeof name, NULL, name);
        const Member *member = find_member(block, name);
        const GLint offset = ask(program, interface.member, (GLuint)variables[i], GL_OFFSET);
        if (member && member->offset != (size_t)offset)
            fail_msg("%s.%s is at %zu in C, at %d in GLSL", block->name, name, member->offset, offset);
        if (!member && !is_later_element(name))
            fail_msg("%s.%s is not in the table of this test", block->name, name);
        found += member != NULL;
    }
    return found;
}

static void blocks_are_the_same_in_c_and_glsl(void **state)
{
    enum { PADDING = 16 }; /* behind the last member, which the driver may leave out */
    (void)state;
    for (const Block *block = blocks; block < blocks + sizeof blocks / sizeof *blocks; block++) {
        const GLuint program = program_with(block->path);
        Interface interface = {GL_UNIFORM_BLOCK, GL_UNIFORM};
        GLuint resource = glGetProgramResourceIndex(program, interface.block, block->name);
        if (resource == GL_INVALID_INDEX) {
            interface = (Interface){GL_SHADER_STORAGE_BLOCK, GL_BUFFER_VARIABLE};
            resource = glGetProgramResourceIndex(program, interface.block, block->name);
        }
        assert_true(resource != GL_INVALID_INDEX);
        assert_int_equal(compare_members(block, program, interface, resource), block->count);
        const size_t size = (size_t)ask(program, interface.block, resource, GL_BUFFER_DATA_SIZE);
        assert_in_range(size, block->size - PADDING, block->size);
        glDeleteProgram(program);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(blocks_are_the_same_in_c_and_glsl, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.blocks", tests, compare_setup, context_teardown);
}

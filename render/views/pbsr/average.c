#include "render/views/pbsr/pbsr.h"

#include "render/frame/passes.h"
#include "render/views/pbsr/pbsr_private.h"
#include "shaders/pbsr/pbsr_block.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

enum { ROOM_MOST = 16, BANDS_MOST = 64 };

static const size_t BYTES_MOST = (size_t)256 << 20;

bool average_create(Average *average, const Subject *subject, bool by_cpu, Error *error)
{
    static const char *const add[] = {"common/screen.vert", "pbsr/average.frag", NULL};
    const char *defines = subject->world->solid_count > 0 ? "#define SOLIDS 1\n" : NULL;
    average->by_cpu = by_cpu;
    glCreateVertexArrays(1, &average->screen);
    glCreateFramebuffers(2, average->framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, average->framebuffer[0], -1, "sets' sum before overlays");
    glObjectLabel(GL_FRAMEBUFFER, average->framebuffer[1], -1, "sets' sum behind overlays");
    glCreateBuffers(1, &average->block);
    glObjectLabel(GL_BUFFER, average->block, -1, "pbsr uniforms");
    glNamedBufferStorage(average->block, sizeof(PbsrBlock), NULL, GL_DYNAMIC_STORAGE_BIT);
    return (average->add = program_create("pbsr average", add, defines, error)) != 0 &&
           (average->mean =
                program_create_pair("pbsr mean", "common/screen.vert", "pbsr/mean.frag", error)) != 0 &&
           color_table_create(&average->colors, view_colormap(subject->def), &subject->def->color_curve,
                              error);
}

void average_destroy(Average *average)
{
    glDeleteProgram(average->add);
    glDeleteProgram(average->mean);
    glDeleteVertexArrays(1, &average->screen);
    glDeleteFramebuffers(2, average->framebuffer);
    glDeleteTextures(3, (GLuint[]){average->sum[0], average->sum[1], average->nearest});
    glDeleteBuffers(2, (GLuint[]){average->block, average->sets});
    color_table_destroy(&average->colors);
}

static GLuint make_texture(const Target *target, GLenum format, const char *label)
{
    GLuint texture;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glObjectLabel(GL_TEXTURE, texture, -1, label);
    glTextureStorage2D(texture, 1, format, target->width, target->height);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

static bool follow_target(Average *average, const Target *target, Error *error)
{
    if (average->target_number == target->number)
        return true;
    glDeleteTextures(3, (GLuint[]){average->sum[0], average->sum[1], average->nearest});
    average->sum[0] = average->sum[1] = average->nearest = average->target_number = 0;
    gl_debug_errors(); /* drops earlier errors: the query below is for these textures */
    average->nearest = make_texture(target, GL_R32F, "sets' nearest depth");
    for (int side = 0; side < 2; side++)
        average->sum[side] = make_texture(target, GL_RGBA32F, "sets' sum");
    if (gl_errors_take(0) > 0)
        return error_set(error, "the GPU has no memory for sums of %d x %d pixels", target->width,
                         target->height);
    for (int side = 0; side < 2; side++)
        glNamedFramebufferTexture(average->framebuffer[side], GL_COLOR_ATTACHMENT0, average->sum[side], 0);
    glNamedFramebufferTexture(average->framebuffer[0], GL_COLOR_ATTACHMENT1, average->nearest, 0);
    glNamedFramebufferDrawBuffers(average->framebuffer[0], 2,
                                  (GLenum[]){GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1});
    average->target_number = target->number;
    return true;
}

/* The bounds of the fluid, at least a pixel; or the whole picture. */
static void follow_part(Average *average, const Frame *frame, bool whole)
{
    const int size[2] = {frame->width, frame->height};
    int bounds[4] = {0, 0, size[0], size[1]};
    if (!whole)
        frame_bounds(frame, bounds);
    for (int k = 0; k < 2; k++) {
        const int low = bounds[k] > 0 ? bounds[k] : 0,
                  end = bounds[2 + k] < size[k] ? bounds[2 + k] : size[k];
        average->part[k] = low < size[k] ? low : size[k] - 1;
        average->part[2 + k] = end > average->part[k] ? end - average->part[k] : 1;
    }
}

static bool make_sets(Average *average, size_t bytes)
{
    enum { WAYS = GL_MAP_READ_BIT | GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT };
    glDeleteBuffers(1, &average->sets);
    average->bytes = 0;
    glCreateBuffers(1, &average->sets);
    glObjectLabel(GL_BUFFER, average->sets, -1, "sets of points");
    gl_debug_errors(); /* drops earlier errors: the query below is for this buffer */
    glNamedBufferStorage(average->sets, (GLsizeiptr)bytes, NULL, average->by_cpu ? WAYS : 0);
    if (average->by_cpu)
        average->mapped = glMapNamedBufferRange(average->sets, 0, (GLsizeiptr)bytes, WAYS);
    if (gl_errors_take(0) > 0 || (average->by_cpu && !average->mapped))
        return false;
    average->bytes = bytes;
    return true;
}

/* As many sets as a storage block allows, limited to save memory. */
static bool follow_sets(Average *average, Error *error)
{
    const int height = average->part[3];
    const size_t row = 2 * sizeof(uint32_t) * (size_t)average->part[2];
    GLint64 block = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block);
    const size_t shown = (size_t)block / row, rows = shown < 1 ? 1 : shown,
                 bands = ((size_t)height + rows - 1) / rows;
    average->rows = (int)(((size_t)height + bands - 1) / bands); /* bands of equal height */
    const size_t one = row * (size_t)average->rows;
    const size_t most = (size_t)block < BYTES_MOST ? (size_t)block : BYTES_MOST, capacity = most / one;
    average->capacity = (int)(capacity < 1 ? 1 : capacity > ROOM_MOST ? ROOM_MOST : capacity);
    const size_t bytes = one * (size_t)average->capacity;
    return (bytes <= average->bytes && bytes > average->bytes / 4) || make_sets(average, bytes) ||
           error_set(error, "no memory for %d sets of points in %d x %d pixels", average->capacity,
                     average->part[2], average->rows);
}

static SetSight sight_of(const Average *average, const Frame *frame)
{
    const float *tangent = frame->camera.tangent;
    const float size[2] = {(float)frame->width, (float)frame->height};
    SetSight sight = {.near_plane = frame->camera.near_plane,
                      .width = average->part[2],
                      .height = average->part[3],
                      .pixel = (float)pixel_area(tangent, frame->width, frame->height, 1)};
    float to_eye[16];
    matrix_multiply(frame->camera.view, frame->box_to_world, to_eye);
    for (int k = 0; k < 4; k++) {
        const float w = -to_eye[4 * k + 2];
        for (int axis = 0; axis < 2; axis++)
            sight.row[axis][k] =
                to_eye[4 * k + axis] * size[axis] / (2 * tangent[axis]) +
                w * (size[axis] * (1 + frame->camera.centre[axis]) / 2 - (float)average->part[axis]);
        sight.row[2][k] = w;
    }
    sight.edges = (float)pbsr_def(frame->def)->edges;
    set_sight_find_eye(&sight);
    sight.low = frame->colors.by_fluid ? 0 : (float)frame->colors.range[0];
    sight.scale = 1 / (frame->colors.by_fluid ? FLUIDS_MAX - 1
                                              : (float)(frame->colors.range[1] - frame->colors.range[0]));
    return sight;
}

/* Columns of the matrix that turns a layer's normals into the eye's frame. */
static void fill_turn(const AverageLook *look, const float to_eye[16], float columns[3][4])
{
    for (int k = 0; k < 3; k++)
        for (int row = 0; row < 3; row++)
            for (int i = 0; i < 3; i++)
                columns[k][row] += to_eye[4 * i + row] * look->turn[i][k];
}

static void fill_block(const Average *average, const Frame *frame, const AverageLook looks[])
{
    const SetSight *sight = &average->sight;
    PbsrBlock block = {.value_low = sight->low, .value_scale = sight->scale, .sets_near = sight->near_plane};
    float to_eye[16];
    matrix_multiply(frame->camera.view, frame->box_to_world, to_eye);
    for (int i = 0; i < PBSR_NUMBERS_MAX; i++) {
        memcpy(block.layer_color[i], looks[i].color, sizeof looks[i].color);
        block.layer_color[i][3] = looks[i].own;
        block.layer_light[i][0] = looks[i].lit;
        block.layer_light[i][1] = looks[i].by_map;
        fill_turn(&looks[i], to_eye, &block.layer_turn[3 * i]);
    }
    glNamedBufferSubData(average->block, 0, sizeof block, &block);
}

bool average_begin(Average *average, const Frame *frame, const AverageLook looks[], bool whole, Error *error)
{
    static const float nothing[4] = {0};
    average->count = 0;
    if (!follow_target(average, frame->target, error))
        return false;
    follow_part(average, frame, whole);
    average->split = frame_over_depth(frame) != 0;
    if (!follow_sets(average, error))
        return false;
    average->sight = sight_of(average, frame);
    average->band[1] = 0; /* the block has no band yet */
    fill_block(average, frame, looks);
    glDisable(GL_SCISSOR_TEST);
    glClearNamedFramebufferfv(average->framebuffer[0], GL_COLOR, 0, nothing);
    glClearNamedFramebufferfv(average->framebuffer[0], GL_COLOR, 1, nothing);
    if (average->split)
        glClearNamedFramebufferfv(average->framebuffer[1], GL_COLOR, 0, nothing);
    return true;
}

bool average_band(Average *average, int number)
{
    const int *part = average->part, first = number * average->rows, left = part[3] - first;
    if (left <= 0)
        return false;
    const int rows = left < average->rows ? left : average->rows;
    if (average->band[0] == first && average->band[1] == rows)
        return true;
    average->band[0] = first;
    average->band[1] = rows;
    const GLint place[5] = {part[0], part[1] + first, part[2], average->band[1], first};
    glNamedBufferSubData(average->block, offsetof(PbsrBlock, sets_part), 4 * sizeof *place, place);
    glNamedBufferSubData(average->block, offsetof(PbsrBlock, sets_first), sizeof *place, &place[4]);
    return true;
}

SetImage average_image(const Average *average, int number)
{
    const int *band = average->band;
    const size_t pixels = (size_t)average->part[2] * (size_t)band[1];
    uint32_t *first = average->mapped + 2 * pixels * (size_t)number;
    return (SetImage){first, first + pixels, band[0], average->part[3] - band[0] - band[1]};
}

/* A rectangle of the band: left, below, right, above; pixels. */
typedef struct PixelRect {
    int x0, y0, x1, y1;
} PixelRect;

/* The columns with points, in the given rows, in any of `sets` sets. */
static PixelRect find_points(const Average *average, int sets, int y0, int y1)
{
    const int width = average->part[2];
    PixelRect piece = {width, y0, 0, y1};
    for (int set = 0; set < sets; set++)
        for (int y = y0; y < y1; y++) {
            const uint32_t *depth = average_image(average, set).depth + (size_t)y * (size_t)width;
            int x = 0, end = width;
            while (x < piece.x0 && depth[x] == 0)
                x++;
            while (end > piece.x1 && depth[end - 1] == 0)
                end--;
            piece.x0 = x;
            piece.x1 = end;
        }
    return piece;
}

/* Finds the rectangles with points, per group of rows: a software driver pays for each pixel of a
   triangle, even if an `if` skips the work. Returns the number of rectangles. */
static int find_pieces(const Average *average, int sets, PixelRect pieces[BANDS_MOST])
{
    const int height = average->band[1], rows = height / BANDS_MOST + 1 > 32 ? height / BANDS_MOST + 1 : 32;
    int count = 0;
    if (!average->by_cpu) {
        pieces[0] = (PixelRect){0, 0, average->part[2], height};
        return 1;
    }
    for (int y = 0; y < height; y += rows) {
        pieces[count] = find_points(average, sets, y, y + rows < height ? y + rows : height);
        count += pieces[count].x0 < pieces[count].x1;
    }
    return count;
}

/* `below`: the part's row where the pieces' rows start. */
static void draw_pieces(const Average *average, int below, const PixelRect pieces[], int count)
{
    const int *part = average->part;
    glEnable(GL_SCISSOR_TEST);
    glEnable(GL_BLEND);
    glBindVertexArray(average->screen);
    for (int i = 0; i < count; i++) {
        const PixelRect *piece = &pieces[i];
        glScissor(part[0] + piece->x0, part[1] + below + piece->y0, piece->x1 - piece->x0,
                  piece->y1 - piece->y0);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
}

static void draw_part(const Average *average)
{
    const PixelRect all = {0, 0, average->part[2], average->part[3]};
    draw_pieces(average, 0, &all, 1);
}

/* Waits until the GPU has read the buffer: the CPU writes next. */
static void wait_for_reading(void)
{
    static const GLuint64 second_ns = 1000000000;
    const GLsync sync = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    while (glClientWaitSync(sync, GL_SYNC_FLUSH_COMMANDS_BIT, second_ns) == GL_TIMEOUT_EXPIRED)
        continue;
    glDeleteSync(sync);
}

static void add_side(const Average *average, GLuint side, const PixelRect pieces[], int count)
{
    glBindFramebuffer(GL_FRAMEBUFFER, average->framebuffer[side]);
    glUniform1ui(SETS_SIDE_AT, side);
    draw_pieces(average, average->band[0], pieces, count);
}

void average_add(Average *average, int sets, const Frame *frame)
{
    PixelRect pieces[BANDS_MOST];
    const int count = find_pieces(average, sets, pieces);
    glViewport(0, 0, frame->width, frame->height);
    glUseProgram(average->add);
    glUniform1ui(SETS_COUNT_AT, (GLuint)sets);
    glBindBufferBase(GL_UNIFORM_BUFFER, PBSR_BLOCK, average->block);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SETS_STORAGE, average->sets);
    glBindTextureUnit(SETS_DEPTH_UNIT, frame->target->depth);
    const GLuint over = frame_over_depth(frame);
    glBindTextureUnit(SETS_OVER_UNIT, over ? over : frame->target->depth);
    color_table_bind(&average->colors, &frame->def->color_curve);
    glDisable(GL_DEPTH_TEST);
    glBlendFunc(GL_ONE, GL_ONE);
    glBlendEquation(GL_FUNC_ADD);
    if (average->split)
        add_side(average, SETS_BACK, pieces, count);
    glBlendEquationi(1, GL_MAX); /* keeps the nearest depth */
    add_side(average, SETS_FRONT, pieces, count);
    glBlendEquation(GL_FUNC_ADD);
    if (average->band[0] + average->band[1] == average->part[3])
        average->count += sets;
    if (average->by_cpu)
        wait_for_reading();
}

static void show(const Average *average, GLuint side, const Frame *frame)
{
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glUseProgram(average->mean);
    glUniform1f(SETS_COUNT_AT, (GLfloat)average->count);
    glUniform1ui(SETS_SIDE_AT, side);
    glBindTextureUnit(SETS_SUM_UNIT, average->sum[0]);
    glBindTextureUnit(SETS_OVER_UNIT, average->sum[1]);
    glBindTextureUnit(SETS_NEAR_UNIT, average->nearest);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glBlendEquation(GL_FUNC_ADD);
    draw_part(average);
}

void average_show_back(const Average *average, const Frame *frame)
{
    glDisable(GL_DEPTH_TEST);
    if (average->split && average->count > 0)
        show(average, SETS_BACK, frame);
}

void average_show_front(const Average *average, const Frame *frame)
{
    if (average->count == 0)
        return;
    glEnable(GL_DEPTH_TEST); /* without depth test no depth is written */
    glDepthFunc(GL_ALWAYS);
    glDepthMask(GL_TRUE);
    show(average, SETS_FRONT, frame);
}

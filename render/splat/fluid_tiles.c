#include "render/splat/fluid_tiles.h"

#include "render/particles/work.h"
#include "shaders/splat/splat_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>

bool fluid_tiles_create(FluidTiles *tiles, Error *error)
{
    static const char *const stages[] = {"splat/tiles_list.comp", NULL};
    *tiles = (FluidTiles){0};
    glCreateVertexArrays(1, &tiles->none);
    work_buffer_remake(&tiles->command, 4 * sizeof(GLuint), "tiles command");
    tiles->list = program_create("tiles list", stages, NULL, error);
    return tiles->list != 0;
}

void fluid_tiles_destroy(FluidTiles *tiles)
{
    glDeleteProgram(tiles->list);
    glDeleteVertexArrays(1, &tiles->none);
    glDeleteBuffers(3, (GLuint[]){tiles->marks, tiles->rects, tiles->command});
    *tiles = (FluidTiles){0};
}

void fluid_tiles_follow(FluidTiles *tiles, const Target *target)
{
    static const GLuint marked = 1;
    if (tiles->target_number == target->number)
        return;
    const size_t columns = ((size_t)target->width + TILE - 1) / TILE,
                 rows = ((size_t)target->height + TILE - 1) / TILE;
    work_buffer_remake(&tiles->marks, columns * rows * sizeof(GLuint), "tiles marks");
    work_buffer_remake(&tiles->rects, (columns + 1) / 2 * rows * 4 * sizeof(GLuint), "tiles rects");
    glClearNamedBufferData(tiles->marks, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &marked);
    tiles->target_number = target->number;
}

void fluid_tiles_list(const FluidTiles *tiles, const Frame *frame, bool all)
{
    GLint bounds[4] = {0};
    if (all)
        frame_bounds(frame, bounds);
    glUseProgram(tiles->list);
    glUniform4iv(TILES_BOUNDS_AT, 1, bounds);
    glUniform2ui(TILES_PICTURE_AT, (GLuint)frame->width, (GLuint)frame->height);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, TILE_MARKS_STORAGE, tiles->marks);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, TILE_RECTS_STORAGE, tiles->rects);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, TILE_COMMAND_STORAGE, tiles->command);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    work_run(1);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT);
}

void fluid_tiles_draw(const FluidTiles *tiles)
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, TILE_RECTS_STORAGE, tiles->rects);
    glBindVertexArray(tiles->none);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, tiles->command);
    glDrawArraysIndirect(GL_TRIANGLES, NULL);
}

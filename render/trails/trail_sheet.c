#include "render/trails/trail_sheet.h"

#include "shaders/trails/trails_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

bool trail_sheet_create(TrailSheet *sheet, Error *error)
{
    glCreateVertexArrays(1, &sheet->none);
    sheet->program =
        program_create_pair("trails' tiles", "trails/trails_tiles.vert", "trails/trails_tiles.frag", error);
    return sheet->program != 0;
}

static void drop(TrailSheet *sheet)
{
    glDeleteTextures(1, &sheet->texels);
    glDeleteBuffers(1, &sheet->pixels);
    glDeleteBuffers(1, &sheet->list);
    free(sheet->kept.pixels);
    free(sheet->kept.tiles);
    free(sheet->shown.tiles);
    free(sheet->changed);
    sheet->kept = sheet->shown = (TrailPicture){0};
    sheet->changed = NULL;
    sheet->texels = sheet->pixels = sheet->list = 0;
    sheet->block = NULL;
    sheet->blocks = 0;
}

void trail_sheet_destroy(TrailSheet *sheet)
{
    drop(sheet);
    glDeleteProgram(sheet->program);
    glDeleteVertexArrays(1, &sheet->none);
    trail_rows_free(&sheet->rows);
    *sheet = (TrailSheet){0};
}

/* Creates a buffer that stays mapped; returns NULL if memory is short. */
static void *make(unsigned *buffer, size_t bytes, const char *label)
{
    const GLbitfield access =
        GL_MAP_READ_BIT | GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    glCreateBuffers(1, buffer);
    glObjectLabel(GL_BUFFER, *buffer, -1, label);
    glNamedBufferStorage(*buffer, (GLsizeiptr)bytes, NULL, access);
    void *mapped = glMapNamedBufferRange(*buffer, 0, (GLsizeiptr)bytes, access);
    if (mapped)
        memset(mapped, 0, bytes);
    return mapped;
}

static void make_all(TrailSheet *sheet, size_t pixels, size_t tiles)
{
    sheet->kept.pixels = calloc(pixels, sizeof(float[4]));
    sheet->kept.tiles = calloc(tiles, 1);
    sheet->shown.pixels = make(&sheet->pixels, pixels * sizeof(float[4]), "trails");
    sheet->shown.tiles = calloc(tiles, 1);
    sheet->changed = calloc(tiles, 1);
    sheet->block = make(&sheet->list, tiles * sizeof *sheet->block, "trails' blocks");
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &sheet->texels);
    glTextureBuffer(sheet->texels, GL_RGBA32F, sheet->pixels);
}

bool trail_sheet_follow(TrailSheet *sheet, int width, int height, bool *anew)
{
    const TrailPicture of = {.width = width,
                             .height = height,
                             .columns = (width + TRAIL_TILE - 1) / TRAIL_TILE,
                             .rows = (height + TRAIL_TILE - 1) / TRAIL_TILE};
    *anew = !sheet->block || sheet->kept.width != width || sheet->kept.height != height;
    if (!*anew)
        return true;
    drop(sheet);
    sheet->kept = sheet->shown = of;
    make_all(sheet, (size_t)width * (size_t)height, (size_t)of.columns * (size_t)of.rows);
    const bool made = sheet->kept.pixels && sheet->kept.tiles && sheet->shown.pixels && sheet->shown.tiles &&
                      sheet->changed && sheet->block;
    if (!made)
        drop(sheet);
    return made;
}

void trail_sheet_clear(TrailSheet *sheet)
{
    for (size_t i = 0; i < (size_t)sheet->kept.columns * (size_t)sheet->kept.rows; i++)
        sheet->changed[i] |= sheet->kept.tiles[i];
    trail_picture_clear(&sheet->kept);
}

/* Restores the tiles drawn over in the last picture, or changed since, from `kept`. */
static void restore(TrailSheet *sheet, size_t tiles)
{
    for (size_t i = 0; i < tiles; i++) {
        if (sheet->shown.tiles[i] | sheet->changed[i])
            trail_picture_copy(&sheet->shown, &sheet->kept, i);
        sheet->shown.tiles[i] = sheet->changed[i] = 0;
    }
}

/* True if the block has any trail; false beyond the picture. */
static bool is_block(const TrailSheet *sheet, int column, int row)
{
    enum { SIDE = TRAIL_BLOCK_SIDE / TRAIL_TILE };
    const TrailPicture *kept = &sheet->kept;
    bool any = false;
    for (int y = SIDE * row; y < SIDE * (row + 1) && y < kept->rows; y++)
        for (int x = SIDE * column; x < SIDE * (column + 1) && x < kept->columns; x++) {
            const size_t tile = (size_t)y * (size_t)kept->columns + (size_t)x;
            any |= kept->tiles[tile] | sheet->shown.tiles[tile];
        }
    return any;
}

static int blocks_along(int pixels)
{
    return (pixels + TRAIL_BLOCK_SIDE - 1) / TRAIL_BLOCK_SIDE;
}

/* Lists neighbouring blocks of a row as one entry. */
static void list(TrailSheet *sheet)
{
    const int columns = blocks_along(sheet->kept.width), rows = blocks_along(sheet->kept.height);
    sheet->blocks = 0;
    for (int row = 0; row < rows; row++)
        for (int first = 0, end; first < columns; first = end + 1) {
            for (end = first; end < columns && is_block(sheet, end, row);)
                end++;
            if (end > first)
                sheet->block[sheet->blocks++] = (uint32_t)row | (uint32_t)first << 10 | (uint32_t)end << 20;
        }
}

bool trail_sheet_draw(TrailSheet *sheet, const TrailSight *sight, const TrailPieces *pieces, size_t fixed,
                      size_t count, size_t slots)
{
    const size_t tiles = (size_t)sheet->kept.columns * (size_t)sheet->kept.rows;
    const TrailPicture into_kept = {sheet->kept.pixels, sheet->changed,      sheet->kept.width,
                                    sheet->kept.height, sheet->kept.columns, sheet->kept.rows};
    bool drawn = trail_rows_draw(&sheet->rows, sight, pieces, fixed, slots, &into_kept);
    for (size_t i = 0; i < tiles; i++)
        sheet->kept.tiles[i] |= sheet->changed[i];
    restore(sheet, tiles);
    drawn =
        drawn && trail_rows_draw(&sheet->rows, sight, pieces + fixed, count - fixed, slots, &sheet->shown);
    list(sheet);
    return drawn;
}

void trail_sheet_show(const TrailSheet *sheet)
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, TRAIL_BLOCKS_STORAGE, sheet->list);
    glBindTextureUnit(TRAIL_LINES_UNIT, sheet->texels);
    glBindVertexArray(sheet->none);
    glDrawArrays(GL_TRIANGLES, 0, (GLsizei)(6 * sheet->blocks));
}

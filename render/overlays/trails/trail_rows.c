#include "render/overlays/trails/trails_private.h"
#include "shaders/trails/trails_bindings.h"
#include "sim/base/base.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STRIPE = TRAIL_TILE, SEEN_FLOATS = 5 }; /* a tile belongs to one thread */

/* A column in the eye's frame: x y z, and pixels from the position of the axis in the picture. */
typedef struct EyePoints {
    float *x, *y, *z, *px, *py;
} EyePoints;

typedef struct TrailRowsJob {
    TrailRows *rows;
    const TrailSight *sight;
    const TrailPieces *pieces;
    const TrailPicture *picture;
    size_t count, slots, parts;
    float scale[2]; /* pixels = at.xy / -at.z times scale */
} TrailRowsJob;

/* Data of a thread: its stripes, and the three columns of the present pieces. */
typedef struct TrailRowsPart {
    const TrailRowsJob *job;
    const TrailPieces *pieces; /* the present column's pieces */
    size_t number;
    EyePoints seen[3]; /* earlier, from, to */
} TrailRowsPart;

/* A corner of a piece, in pixels from the picture's lower left corner. */
typedef struct TrailCorner {
    float x, y;
} TrailCorner;

/* Values at a piece's start and end, interpolated between. */
typedef struct TrailInk {
    float time[2], value[2], depth[2], half;
    bool known;
} TrailInk;

/* ---- eye space ---- */

/* Points at or behind the eye's plane get useless pixels, which are never read. */
static void see(const TrailRowsJob *job, const float *restrict place, EyePoints *seen)
{
    const float *m = job->sight->box_to_eye;
    float *restrict x = seen->x, *restrict y = seen->y, *restrict z = seen->z;
    float *restrict px = seen->px, *restrict py = seen->py;
    const float across = job->scale[0], up = job->scale[1];
    for (size_t i = 0; i < job->slots; i++) {
        const float a = place[4 * i], b = place[4 * i + 1], c = place[4 * i + 2];
        x[i] = m[0] * a + m[4] * b + m[8] * c + m[12];
        y[i] = m[1] * a + m[5] * b + m[9] * c + m[13];
        z[i] = m[2] * a + m[6] * b + m[10] * c + m[14];
        const float near = -1 / z[i];
        px[i] = x[i] * near * across;
        py[i] = y[i] * near * up;
    }
}

static bool joined(const TrailSight *sight, const TrailPoints *from, const TrailPoints *to, size_t i)
{
    const uint32_t a = from->owner[i], b = to->owner[i];
    if (a == 0 || a >> 1 != b >> 1 || !(b & 1))
        return false;
    bool near = true;
    for (size_t k = 0; k < 3; k++)
        near &= fabsf(to->place[4 * i + k] - from->place[4 * i + k]) <= sight->wrap[k];
    return near;
}

/* ---- a piece ---- */

static void leave(const TrailRowsPart *part, const TrailInk *ink, int x, int y, float share, float across)
{
    const TrailPicture *picture = part->job->picture;
    const float covered = ink->half + 0.5F - fabsf(across);
    float *to = picture->pixels + 4 * ((size_t)y * (size_t)picture->width + (size_t)x);
    const float left = covered < 0 ? 0 : covered > 1 ? 1 : covered;
    to[0] = ink->time[0] + (ink->time[1] - ink->time[0]) * share;
    to[1] = ink->value[0] + (ink->value[1] - ink->value[0]) * share;
    to[2] = ink->depth[0] + (ink->depth[1] - ink->depth[0]) * share;
    to[3] = ink->known ? left : -left;
    picture->tiles[(size_t)(y / TRAIL_TILE) * (size_t)picture->columns + (size_t)(x / TRAIL_TILE)] = 1;
}

static int whole(float x, int most)
{
    return x > 0 ? x < (float)most ? (int)x : most : 0;
}

/* Fills the pixels with centres in a triangle, edges included, in the part's stripes. `share` and
   `across`: values at the corners. */
static void fill(const TrailRowsPart *part, const TrailInk *ink, const TrailCorner c[3], const float share[3],
                 const float across[3])
{
    const TrailPicture *picture = part->job->picture;
    const float area = (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y);
    if (!(fabsf(area) > 1e-12F))
        return;
    const float inverse = 1 / area;
    const float low = fminf(c[0].y, fminf(c[1].y, c[2].y)), high = fmaxf(c[0].y, fmaxf(c[1].y, c[2].y));
    const float left = fminf(c[0].x, fminf(c[1].x, c[2].x)), right = fmaxf(c[0].x, fmaxf(c[1].x, c[2].x));
    const int first = whole(ceilf(left - 0.5F), picture->width),
              end = whole(floorf(right + 0.5F), picture->width);
    const int top = whole(floorf(high + 0.5F), picture->height);
    /* change of the weights of corners 1 and 2 from pixel to pixel along a row */
    const float step1 = (c[2].y - c[0].y) * inverse, step2 = -(c[1].y - c[0].y) * inverse;
    for (int y = whole(ceilf(low - 0.5F), picture->height); y < top; y++) {
        if ((size_t)(y / STRIPE) % part->job->parts != part->number)
            continue;
        const float dy = (float)y + 0.5F - c[0].y;
        for (int x = first; x < end; x++) {
            const float dx = (float)x + 0.5F - c[0].x;
            const float one = dx * step1 - dy * (c[2].x - c[0].x) * inverse,
                        two = dx * step2 + dy * (c[1].x - c[0].x) * inverse, none = 1 - one - two;
            if (one >= 0 && two >= 0 && none >= 0)
                leave(part, ink, x, y, none * share[0] + one * share[1] + two * share[2],
                      none * across[0] + one * across[1] + two * across[2]);
        }
    }
}

/* The fraction of the way to the other end where the piece is first in front of the eye. */
static float cut(const TrailSight *sight, float own, float other)
{
    const float clear = -2 * sight->near_plane;
    return own <= clear ? 0 : (own - clear) / (own - other);
}

/* A unit vector perpendicular to `along`. */
static TrailCorner across_of(TrailCorner along)
{
    const float length = sqrtf(along.x * along.x + along.y * along.y), most = fmaxf(length, 1e-9F);
    return (TrailCorner){-along.y / most, along.x / most};
}

/* The point of piece i at the fraction `share` of its length, in pixels from the middle; and the depth. */
static TrailCorner end_of(const TrailRowsPart *part, size_t i, float share, float *depth)
{
    const EyePoints *from = &part->seen[1], *to = &part->seen[2];
    if (share == 0 || share == 1) {
        const EyePoints *at = share == 0 ? from : to;
        *depth = part->job->sight->near_plane / -at->z[i];
        return (TrailCorner){at->px[i], at->py[i]};
    }
    const float x = from->x[i] + (to->x[i] - from->x[i]) * share,
                y = from->y[i] + (to->y[i] - from->y[i]) * share,
                z = from->z[i] + (to->z[i] - from->z[i]) * share;
    *depth = part->job->sight->near_plane / -z;
    return (TrailCorner){x / -z * part->job->scale[0], y / -z * part->job->scale[1]};
}

/* The side direction at the start: perpendicular to the previous piece, if that piece is in front of the
   eye and the trail does not turn back. */
static TrailCorner side_at_start(const TrailRowsPart *part, size_t i, TrailCorner first, TrailCorner along)
{
    const EyePoints *earlier = &part->seen[0];
    const TrailPieces *pieces = part->pieces;
    const TrailSight *sight = part->job->sight;
    if (!pieces->earlier.owner || !joined(sight, &pieces->earlier, &pieces->from, i) ||
        !(earlier->z[i] < -2 * sight->near_plane))
        return across_of(along);
    const TrailCorner came = {first.x - earlier->px[i], first.y - earlier->py[i]};
    return came.x * along.x + came.y * along.y > 0 ? across_of(came) : across_of(along);
}

static float mix(float a, float b, float share)
{
    return a + (b - a) * share;
}

/* True if the piece is outside the picture or outside the part's rows. */
static bool is_elsewhere(const TrailRowsPart *part, TrailCorner a, TrailCorner b, float reach)
{
    const TrailPicture *picture = part->job->picture;
    const float low = fminf(a.y, b.y) - reach, high = fmaxf(a.y, b.y) + reach;
    if (!(high > 0 && low < (float)picture->height && fmaxf(a.x, b.x) + reach > 0 &&
          fminf(a.x, b.x) - reach < (float)picture->width))
        return true;
    const size_t first = (size_t)whole(low, picture->height) / STRIPE,
                 last = (size_t)whole(high, picture->height) / STRIPE, parts = part->job->parts;
    return last - first + 1 < parts && (part->number + parts - first % parts) % parts > last - first;
}

static void draw_piece(const TrailRowsPart *part, size_t i)
{
    const TrailRowsJob *job = part->job;
    const TrailSight *sight = job->sight;
    const TrailPieces *pieces = part->pieces;
    const TrailPicture *picture = job->picture;
    const float clear = -2 * sight->near_plane, za = part->seen[1].z[i], zb = part->seen[2].z[i];
    if (!joined(sight, &pieces->from, &pieces->to, i) || (za > clear && zb > clear))
        return;
    const float start = cut(sight, za, zb), stop = 1 - cut(sight, zb, za), reach = sight->half_width + 0.5F;
    TrailInk ink = {.half = sight->half_width, .known = pieces->known};
    const TrailCorner first = end_of(part, i, start, &ink.depth[0]),
                      last = end_of(part, i, stop, &ink.depth[1]);
    const float middle[2] = {0.5F * (float)picture->width * (1 + sight->centre[0]),
                             0.5F * (float)picture->height * (1 + sight->centre[1])};
    const TrailCorner a = {first.x + middle[0], first.y + middle[1]},
                      b = {last.x + middle[0], last.y + middle[1]};
    if (is_elsewhere(part, a, b, reach))
        return;
    const TrailCorner along = {last.x - first.x, last.y - first.y}, side = across_of(along),
                      came = start == 0 ? side_at_start(part, i, first, along) : side;
    const float shares[2] = {start, stop};
    for (int k = 0; k < 2; k++) {
        ink.time[k] = mix(pieces->times[0], pieces->times[1], shares[k]);
        ink.value[k] = mix(pieces->from.place[4 * i + 3], pieces->to.place[4 * i + 3], shares[k]);
    }
    const TrailCorner corners[4] = {{a.x - came.x * reach, a.y - came.y * reach},
                                    {b.x - side.x * reach, b.y - side.y * reach},
                                    {a.x + came.x * reach, a.y + came.y * reach},
                                    {b.x + side.x * reach, b.y + side.y * reach}};
    fill(part, &ink, (TrailCorner[]){corners[0], corners[1], corners[2]}, (float[]){0, 1, 0},
         (float[]){-reach, -reach, reach});
    fill(part, &ink, (TrailCorner[]){corners[2], corners[1], corners[3]}, (float[]){0, 1, 1},
         (float[]){reach, -reach, reach});
}

/* ---- all pieces ---- */

static EyePoints seen_at(float *at, size_t slots)
{
    return (EyePoints){at, at + slots, at + 2 * slots, at + 3 * slots, at + 4 * slots};
}

/* Columns follow each other: eye-space points of one column serve the next. */
static void draw_part(const TrailRowsJob *job, size_t number)
{
    const size_t column = SEEN_FLOATS * job->slots;
    float *own = job->rows->seen + 3 * column * number;
    TrailRowsPart part = {.job = job, .number = number};
    for (size_t k = 0; k < 3; k++)
        part.seen[k] = seen_at(own + k * column, job->slots);
    for (size_t k = 0; k < job->count; k++) {
        const TrailPieces *pieces = part.pieces = &job->pieces[k];
        if (k > 0 && job->pieces[k - 1].to.place == pieces->from.place) {
            const EyePoints gone = part.seen[0];
            part.seen[0] = part.seen[1];
            part.seen[1] = part.seen[2];
            part.seen[2] = gone;
        } else {
            if (pieces->earlier.owner)
                see(job, pieces->earlier.place, &part.seen[0]);
            see(job, pieces->from.place, &part.seen[1]);
        }
        see(job, pieces->to.place, &part.seen[2]);
        for (size_t i = 0; i < job->slots; i++)
            draw_piece(&part, i);
    }
}

static void draw_parts(void *context, size_t begin, size_t end)
{
    for (; begin < end; begin++)
        draw_part(context, begin);
}

/* Draws `count` columns of pieces of `slots` trails each, in order. Returns false if memory is short. */
static bool trail_rows_draw(TrailRows *rows, const TrailSight *sight, const TrailPieces *pieces, size_t count,
                            size_t slots, const TrailPicture *picture)
{
    const int threads = parallel_processors();
    if (count == 0)
        return true;
    const size_t capacity = 3 * SEEN_FLOATS * slots * (size_t)threads;
    if (capacity > rows->seen_capacity) {
        free(rows->seen);
        rows->seen = malloc(capacity * sizeof *rows->seen);
        rows->seen_capacity = rows->seen ? capacity : 0;
        if (!rows->seen)
            return false;
    }
    TrailRowsJob job = {.rows = rows,
                        .sight = sight,
                        .pieces = pieces,
                        .picture = picture,
                        .count = count,
                        .slots = slots,
                        .parts = (size_t)threads,
                        .scale = {0.5F * (float)picture->width / sight->tangent[0],
                                  0.5F * (float)picture->height / sight->tangent[1]}};
    parallel_ranges(threads, job.parts, 1, draw_parts, &job);
    return true;
}

static void trail_rows_free(TrailRows *rows)
{
    free(rows->seen);
    *rows = (TrailRows){0};
}

/* The first pixel of a tile; `size`: width and height in pixels. */
static float *tile_of(const TrailPicture *picture, size_t tile, int size[2])
{
    const int x = (int)(tile % (size_t)picture->columns) * TRAIL_TILE,
              y = (int)(tile / (size_t)picture->columns) * TRAIL_TILE;
    size[0] = picture->width - x < TRAIL_TILE ? picture->width - x : TRAIL_TILE;
    size[1] = picture->height - y < TRAIL_TILE ? picture->height - y : TRAIL_TILE;
    return picture->pixels + 4 * ((size_t)y * (size_t)picture->width + (size_t)x);
}

/* Copies a tile between pictures of equal size. */
static void trail_picture_copy(const TrailPicture *to, const TrailPicture *from, size_t tile)
{
    int size[2];
    float *out = tile_of(to, tile, size), *in = tile_of(from, tile, size);
    for (int y = 0; y < size[1]; y++)
        memcpy(out + 4 * y * to->width, in + 4 * y * from->width, 4 * sizeof *out * (size_t)size[0]);
}

/* Clears all drawn tiles. */
static void trail_picture_clear(const TrailPicture *picture)
{
    for (size_t i = 0; i < (size_t)picture->columns * (size_t)picture->rows; i++) {
        int size[2];
        float *at = tile_of(picture, i, size);
        for (int y = 0; picture->tiles[i] && y < size[1]; y++)
            memset(at + 4 * y * picture->width, 0, 4 * sizeof *at * (size_t)size[0]);
        picture->tiles[i] = 0;
    }
}

bool trail_canvas_create(TrailCanvas *sheet, Error *error)
{
    glCreateVertexArrays(1, &sheet->none);
    sheet->program =
        program_create_pair("trails' tiles", "trails/trails_tiles.vert", "trails/trails_tiles.frag", error);
    return sheet->program != 0;
}

static void free_buffers(TrailCanvas *sheet)
{
    glDeleteTextures(1, &sheet->texels);
    glDeleteBuffers(1, &sheet->pixels);
    glDeleteBuffers(1, &sheet->list);
    free(sheet->fixed.pixels);
    free(sheet->fixed.tiles);
    free(sheet->shown.tiles);
    free(sheet->changed);
    sheet->fixed = sheet->shown = (TrailPicture){0};
    sheet->changed = NULL;
    sheet->texels = sheet->pixels = sheet->list = 0;
    sheet->block = NULL;
    sheet->blocks = 0;
}

void trail_canvas_destroy(TrailCanvas *sheet)
{
    free_buffers(sheet);
    glDeleteProgram(sheet->program);
    glDeleteVertexArrays(1, &sheet->none);
    trail_rows_free(&sheet->rows);
    *sheet = (TrailCanvas){0};
}

/* Creates a buffer that stays mapped; returns NULL if memory is short. */
static void *make_picture(unsigned *buffer, size_t bytes, const char *label)
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

static void make_buffers(TrailCanvas *sheet, size_t pixels, size_t tiles)
{
    sheet->fixed.pixels = calloc(pixels, sizeof(float[4]));
    sheet->fixed.tiles = calloc(tiles, 1);
    sheet->shown.pixels = make_picture(&sheet->pixels, pixels * sizeof(float[4]), "trails");
    sheet->shown.tiles = calloc(tiles, 1);
    sheet->changed = calloc(tiles, 1);
    sheet->block = make_picture(&sheet->list, tiles * sizeof *sheet->block, "trails' blocks");
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &sheet->texels);
    glTextureBuffer(sheet->texels, GL_RGBA32F, sheet->pixels);
}

bool trail_canvas_update(TrailCanvas *sheet, int width, int height, bool *anew)
{
    const TrailPicture of = {.width = width,
                             .height = height,
                             .columns = (width + TRAIL_TILE - 1) / TRAIL_TILE,
                             .rows = (height + TRAIL_TILE - 1) / TRAIL_TILE};
    *anew = !sheet->block || sheet->fixed.width != width || sheet->fixed.height != height;
    if (!*anew)
        return true;
    free_buffers(sheet);
    sheet->fixed = sheet->shown = of;
    make_buffers(sheet, (size_t)width * (size_t)height, (size_t)of.columns * (size_t)of.rows);
    const bool made = sheet->fixed.pixels && sheet->fixed.tiles && sheet->shown.pixels &&
                      sheet->shown.tiles && sheet->changed && sheet->block;
    if (!made)
        free_buffers(sheet);
    return made;
}

void trail_canvas_clear(TrailCanvas *sheet)
{
    for (size_t i = 0; i < (size_t)sheet->fixed.columns * (size_t)sheet->fixed.rows; i++)
        sheet->changed[i] |= sheet->fixed.tiles[i];
    trail_picture_clear(&sheet->fixed);
}

/* Restores the tiles drawn over in the last picture, or changed since, from `kept`. */
static void restore_shown(TrailCanvas *sheet, size_t tiles)
{
    for (size_t i = 0; i < tiles; i++) {
        if (sheet->shown.tiles[i] | sheet->changed[i])
            trail_picture_copy(&sheet->shown, &sheet->fixed, i);
        sheet->shown.tiles[i] = sheet->changed[i] = 0;
    }
}

/* True if the block has any trail; false beyond the picture. */
static bool is_block(const TrailCanvas *sheet, int column, int row)
{
    enum { SIDE = TRAIL_BLOCK_SIDE / TRAIL_TILE };
    const TrailPicture *fixed = &sheet->fixed;
    bool any = false;
    for (int y = SIDE * row; y < SIDE * (row + 1) && y < fixed->rows; y++)
        for (int x = SIDE * column; x < SIDE * (column + 1) && x < fixed->columns; x++) {
            const size_t tile = (size_t)y * (size_t)fixed->columns + (size_t)x;
            any |= fixed->tiles[tile] | sheet->shown.tiles[tile];
        }
    return any;
}

static int blocks_along(int pixels)
{
    return (pixels + TRAIL_BLOCK_SIDE - 1) / TRAIL_BLOCK_SIDE;
}

/* Lists neighbouring blocks of a row as one entry. */
static void list(TrailCanvas *sheet)
{
    const int columns = blocks_along(sheet->fixed.width), rows = blocks_along(sheet->fixed.height);
    sheet->blocks = 0;
    for (int row = 0; row < rows; row++)
        for (int first = 0, end; first < columns; first = end + 1) {
            for (end = first; end < columns && is_block(sheet, end, row);)
                end++;
            if (end > first)
                sheet->block[sheet->blocks++] = (uint32_t)row | (uint32_t)first << 10 | (uint32_t)end << 20;
        }
}

bool trail_canvas_draw(TrailCanvas *sheet, const TrailSight *sight, const TrailPieces *pieces, size_t fixed,
                       size_t count, size_t slots)
{
    const size_t tiles = (size_t)sheet->fixed.columns * (size_t)sheet->fixed.rows;
    const TrailPicture into_kept = {sheet->fixed.pixels, sheet->changed,       sheet->fixed.width,
                                    sheet->fixed.height, sheet->fixed.columns, sheet->fixed.rows};
    bool drawn = trail_rows_draw(&sheet->rows, sight, pieces, fixed, slots, &into_kept);
    for (size_t i = 0; i < tiles; i++)
        sheet->fixed.tiles[i] |= sheet->changed[i];
    restore_shown(sheet, tiles);
    drawn =
        drawn && trail_rows_draw(&sheet->rows, sight, pieces + fixed, count - fixed, slots, &sheet->shown);
    list(sheet);
    return drawn;
}

void trail_canvas_show(const TrailCanvas *sheet)
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, TRAIL_BLOCKS_STORAGE, sheet->list);
    glBindTextureUnit(TRAIL_LINES_UNIT, sheet->texels);
    glBindVertexArray(sheet->none);
    glDrawArrays(GL_TRIANGLES, 0, (GLsizei)(6 * sheet->blocks));
}

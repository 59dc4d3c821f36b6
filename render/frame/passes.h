/* Parts of pictures that several passes share: meshes of solids, the edges of the box, copies of colour and
   depth, enlargement of a coarse picture, legend and title. The passes are effects: render/frame/effect.h.
   Needs a current OpenGL 4.5 core context. */
#ifndef RENDER_FRAME_PASSES_H
#define RENDER_FRAME_PASSES_H

#include "render/frame/frame.h"
#include "render/ui/text.h"
#include "sim/def.h"
#include "sim/error.h"
#include "sim/gpu/particle_buffers.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct Picture;

/* Solids as closed triangle meshes with normals: smooth along their curves, crisp at their edges. */

typedef struct SolidVertex {
    float position[3]; /* in the solid's own frame, m */
    float normal[3];   /* unit, outwards */
    uint32_t solid;    /* number of the vertex's solid */
} SolidVertex;

/* Mesh of any number of solids; zero-initialise. Front faces are counter-clockwise seen from outside. */
typedef struct SolidMesh {
    SolidVertex *vertices;
    uint32_t *indices; /* three per triangle */
    size_t vertex_count, index_count, vertex_capacity, index_capacity;
} SolidMesh;

/* Adds a solid. `slab` > 0: depth of a flat box, m. The solid is then its section with the plane, extruded
   along z; a cylinder has no such form and stays a cylinder. Returns false if memory is short; the mesh is
   then unusable. */
bool solid_mesh_add(SolidMesh *mesh, const SolidDef *solid, double slab, uint32_t number);

void solid_mesh_destroy(SolidMesh *mesh);

/* True if both solids have the same mesh. */
bool solid_mesh_same(const SolidDef *a, const SolidDef *b);

/* Matrix from the frame of the scene's solid `number` to the world, at the state's time. */
void solid_to_world(const SolidDef *solid, int number, const ParticleBuffers *particles, const Frame *frame,
                    float to_world[16]);

/* Updates meshes and poses for the picture's state, and draws the solids' sides away from the light into the
   bound map. */
void solids_cast(const struct Picture *picture);

/* The edges of the box: thin, smooth lines, hidden by objects in front. */

typedef struct BoxEdges {
    unsigned program;
    unsigned vertex_array, indices;
} BoxEdges;

bool box_edges_create(BoxEdges *edges, Error *error);
void box_edges_destroy(BoxEdges *edges);
/* The background of a clear fluid: a copy of the target's colour and depth, for shaders of refraction.
   shaders/common/behind.glsl reads the copy. */

typedef struct BackgroundCopy {
    unsigned target_number; /* number of the target that gave the textures their size */
    unsigned color, depth;  /* textures like the target's; no depth without solids */
    unsigned framebuffer;   /* the colour texture with the target's depth */
} BackgroundCopy;

/* Copies the picture so far and binds the copy to texture units 14 (colour), 15 (depth, if the scene has
   solids) and 3 (light on the floor). `edges`: the box's far edges are added if the picture shows the box;
   NULL: none. Zero-initialise *background. */
void background_copy_make(BackgroundCopy *background, const BoxEdges *edges, const Frame *frame);

/* For shaders that compute sky and floor themselves: the copy holds only these edges, colour multiplied by
   coverage, and the coverage in alpha. Binds units 14 and 3. */
void background_copy_make_edges(BackgroundCopy *background, const BoxEdges *edges, const Frame *frame);

void background_copy_destroy(BackgroundCopy *background);

/* Depths of all objects drawn over a view, including lines without depth in the picture: for a view with
   parts in front of and behind these objects (ViewKind.draw_front). Made by effect_overlay_depth. */

/* Zero-initialise. */
typedef struct OverlayDepth {
    unsigned framebuffer, depth; /* GL names; depth format as in Target; depth 0: the GPU has no memory */
    int width, height;
    bool coarse; /* the overlays' depths are incomplete; the next picture has better ones */
} OverlayDepth;

/* The texture of the frame's depths over the view; 0: none. */
static inline unsigned frame_over_depth(const Frame *frame)
{
    return frame->over ? frame->over->depth : 0;
}

/* A picture of another resolution than shown: drawn with fewer pixels, then enlarged; or with more, whose
   means are shown, for smooth outlines. Edges and text are drawn at full resolution over the result. Needs a
   current OpenGL 4.5 core context. */

/* Zero-initialise: then pictures have full resolution. */
typedef struct Upscale {
    Target target;  /* framebuffer 0: as many pixels as shown */
    bool fine;      /* more pixels than shown */
    unsigned shown; /* texture view of the target's colour: sRGB-encoded bytes, or, if fine,
                       linear light */
    unsigned program, edges, vertices; /* `edges`: program for the box's edges, tested against the target's
                                          depth */
} Upscale;

/* Adapts to a picture of `width` x `height` pixels, drawn at `resolution` times the pixels along each axis,
   0 .. 2; 1: all zero. Above 1 less for a picture so large that more than 2^24 pixels would be drawn.
   Returns false on failure and changes nothing. */
bool upscale_update(Upscale *coarse, double resolution, int width, int height, Error *error);
void upscale_destroy(Upscale *coarse);

/* Copies the depth, not interpolated, into a target of any size. */
void upscale_depth(const Upscale *coarse, const Target *to);

/* The legend: the colours with unit and ticks, or the fluids' names; and the simulated time. */

/* Round, equidistant numbers in min .. max, at most `most`. Returns the count; fills `ticks` in rising
   order and `decimals` with the number of decimals that distinguishes the ticks. */
int legend_ticks(double min, double max, int most, double ticks[], int *decimals);

/* Converts a unit to typeset form: "kg/m3" to "kg/m³". */
void legend_unit(const char *unit, char out[32]);

/* Text colour over a picture of the def, 0xRRGGBBff in sRGB: dark on bright backgrounds. */
uint32_t legend_text_color(const ViewDef *def);

/* Letter height for a picture of `height`, pixels. */
float legend_text_pixels(int height);

/* Width of the legend with margin, at the right side of a picture of `height`; 0 without a legend.
   Estimates the width of the fluids' names: exact widths need a font. */
double legend_width_pixels(const ViewDef *def, const WorldDef *world, int height);

/* The corner of a picture to keep free for the legend, the same for the fluids and for all scalars: the box
   does not move from view to view. Nothing without a legend. */
CoveredParts legend_room(const ViewDef *def, const WorldDef *world, int width, int height);

/* The title of a picture, in the upper left corner: for one of several panels (render/renderer.h). */

enum { TITLE_SIZE = 160 };

/* All zero: no title. */
typedef struct Title {
    char words[TITLE_SIZE];   /* "particles 2000"; "": no title */
    char figures[TITLE_SIZE]; /* fainter, below the words; "": none */
} Title;

/* True if a picture by `def` has words: needs a Text. */
bool has_letters(const ViewDef *def, const Title *title);

/* Pixel rows, from the top, that a title may cover in a picture of `height`. */
int title_rows(const Title *title, int height);

#endif

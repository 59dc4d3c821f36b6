/* The passes that every picture has, in drawing order: backdrop, shadows, solids, the edges of the box,
   copies of colour and depth, enlargement of a coarse picture, legend and title. Each section says what a
   pass reads, writes and owns. Needs a current OpenGL 4.5 core context. */
#ifndef RENDER_FRAME_PASSES_H
#define RENDER_FRAME_PASSES_H

#include "render/frame/frame.h"

#include "render/frame/text.h"
#include "sim/gpu/particle_buffers.h"
#include "slosh/def.h"
#include "slosh/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The backdrop: sky and floor, the first pass of a picture; the floor is lit by Frame.floor_light. Writes
   the target's colour; no depth.

   Without the fluid's shadow the backdrop depends on the camera alone and is kept while the camera stands
   still. Then a picture costs a copy, and shading of the floor area that the shadow may reach. */

enum { BACKDROP_KEY_SIZE = 32 };

typedef struct Backdrop {
    unsigned program, shadow_program, vertex_array;
    double seen[BACKDROP_KEY_SIZE]; /* all inputs of sky and lit floor in the last picture */
    bool kept;                      /* `kept_color` holds the backdrop of `seen` */
    unsigned kept_framebuffer, kept_color;
    unsigned kept_target; /* number of the target that gave both objects their size; 0: not created yet */
} Backdrop;

bool backdrop_create(Backdrop *backdrop, Error *error);
void backdrop_destroy(Backdrop *backdrop);
void backdrop_draw(Backdrop *backdrop, const Frame *frame);

/* The shadow maps, seen from the light. A view draws its casters between shadow_begin and shadow_end;
   spheres.frag and the floor read the maps. Solids have a separate map, present only in scenes with
   solids: shadows of solids are full at once, while the fluid's own shadow fades with depth. */

typedef struct Shadow {
    unsigned framebuffer, map;             /* depth, SHADOW_MAP_TEXELS squared */
    unsigned floor_framebuffer, floor_map; /* light left on the floor, FLOOR_MAP_TEXELS squared */
    unsigned floor_program, vertex_array;
    unsigned solid_framebuffer, solid_map, solid_floor_program; /* 0 without solids */
} Shadow;

bool shadow_create(Shadow *shadow, Error *error);
void shadow_destroy(Shadow *shadow);

/* Creates or drops the solids' map. Returns false on failure and changes nothing. */
bool shadow_update_solids(Shadow *shadow, bool solids, Error *error);

/* Change framebuffer, viewport and depth function: for the casters of a view; for solids. */
void shadow_begin(const Shadow *shadow);
void shadow_begin_solids(const Shadow *shadow);

/* Draws the shadow on the floor if the frame has a floor, and binds the maps to texture units: 0, and 4
   for solids. */
void shadow_end(const Shadow *shadow, const Frame *frame);

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

/* Solids: lit and opaque, drawn before every view, so that the view's depth test hides covered parts.
   Reads the def's solids at the state's time; writes the target's colour and depth, and the solids' shadow
   map. Owns meshes and poses. Exists only in scenes with solids. */

typedef struct Solids Solids;

Solids *solids_create(Error *error); /* NULL on failure */
void solids_destroy(Solids *solids); /* NULL is allowed */

/* Matrix from the frame of the scene's solid `number` to the world, at the state's time. */
void solid_to_world(const SolidDef *solid, int number, const ParticleBuffers *particles, const Frame *frame,
                    float to_world[16]);

/* Updates the poses for the state's time; call before solids_cast and solids_draw. Makes the meshes again
   only if shapes, or the depth of a flat box, have changed. If memory is short, there are no meshes. */
void solids_update_poses(Solids *solids, const ParticleBuffers *particles, const Frame *frame);

/* Draws into the map of shadow_begin_solids. */
void solids_cast(const Solids *solids);

void solids_draw(const Solids *solids, const Frame *frame);

/* The edges of the box: thin, smooth lines, hidden by objects in front. Blends colour and tests depth;
   writes depth if Frame.depths. */

typedef struct BoxEdges {
    unsigned program;
    unsigned vertex_array, indices;
} BoxEdges;

bool box_edges_create(BoxEdges *edges, Error *error);
void box_edges_destroy(BoxEdges *edges);
void box_edges_draw(const BoxEdges *edges, const Frame *frame);

/* Draws with `program`, the shaders compiled with COARSE, into the bound framebuffer, whose colours are
   encoded. Tests against `depth`, a depth texture of another size. */
void box_edges_draw_upscaled(const BoxEdges *edges, unsigned program, const Frame *frame, unsigned depth);

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
   parts in front of and behind these objects (ViewKind.draw_front). Needs a current OpenGL 4.5 core
   context. */

/* Zero-initialise. */
typedef struct OverlayDepth {
    unsigned framebuffer, depth; /* GL names; depth format as in Target */
    int width, height;
} OverlayDepth;

/* Copies the target's present depths; `to`: a target without colour, for the overlays' and edges' depths.
   Returns false if the driver has no memory. */
bool overlay_depth_begin(OverlayDepth *over, const Target *target, Target *to);

void overlay_depth_destroy(OverlayDepth *over); /* a zeroed struct is allowed */

/* A coarse picture: drawn with fewer pixels than shown, then enlarged. Edges and text are drawn at full
   resolution over the enlarged picture. Needs a current OpenGL 4.5 core context. */

/* Zero-initialise: then pictures have full resolution. */
typedef struct Upscale {
    Target target;                     /* framebuffer 0: no coarse picture */
    unsigned encoded;                  /* texture view of the target's colour, as sRGB-encoded bytes */
    unsigned program, edges, vertices; /* `edges`: program for box_edges_draw_upscaled, tested against the
                                          target's depth */
} Upscale;

/* Adapts to a picture of `width` x `height` pixels, drawn at the fraction `resolution` (0 .. 1) along each
   axis; 1: all zero. Returns false on failure and changes nothing. */
bool upscale_update(Upscale *coarse, double resolution, int width, int height, Error *error);
void upscale_destroy(Upscale *coarse);

/* Fills a framebuffer of `width` x `height` pixels with the colour, interpolated linearly. Leaves the
   framebuffer bound and sRGB encoding off. Interpolates encoded colours: linear light would cost a
   software driver twice the time. */
void upscale_draw(const Upscale *coarse, unsigned framebuffer, int width, int height);

/* Copies the depth, not interpolated, into a target of any size. */
void upscale_depth(const Upscale *coarse, const Target *to);

/* The legend: the colours with unit and ticks, or the fluids' names; and the simulated time. */

/* Round, equidistant numbers in min .. max, at most `most`. Returns the count; fills `ticks` in rising
   order and `decimals` with the number of decimals that distinguishes the ticks. */
int legend_ticks(double min, double max, int most, double ticks[], int *decimals);

/* Converts a unit to typeset form: "kg/m3" to "kg/m³". */
void legend_unit(const char *unit, char out[32]);

void legend_draw(Text *text, const Frame *frame, double time);

/* Text colour over a picture of the def, 0xRRGGBBff in sRGB: dark on bright backgrounds. */
uint32_t legend_text_color(const ViewDef *def);

/* Draws a line of text at x, y (pixels from the left and the top) in the legend's faint ink. */
void legend_line(Text *text, const Frame *frame, float x, float y, const char *line);

/* Letter height for a picture of `height`, pixels. */
float legend_text_pixels(int height);

/* Width of the legend with margin, at the right side of a picture of `height`; 0 without a legend.
   Estimates the width of the fluids' names: exact widths need a font. */
double legend_width_pixels(const ViewDef *def, const WorldDef *world, int height);

/* The title of a picture, in the upper left corner: for one of several panels (render/panels.h). */

enum { TITLE_SIZE = 160 };

/* All zero: no title. */
typedef struct Title {
    char words[TITLE_SIZE];   /* "particles 2000"; "": no title */
    char figures[TITLE_SIZE]; /* fainter, below the words; "": none */
} Title;

/* Leaves room for the legend: wider text is cut and ends with "...". */
void title_draw(Text *text, const Title *title, const Frame *frame);

/* Draws the def's title, `view.title`, in the middle of the free lower edge; smaller if too wide. */
void caption_draw(Text *text, const Frame *frame);

/* Pixel rows, from the top, that a title may cover in a picture of `height`. */
int title_rows(const Title *title, int height);

#endif

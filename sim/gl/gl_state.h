/* The state of a GL context that passes of a solver change while they draw: kept before, put back after,
   since the views draw in the same context. Texture units and programs are not part of it: every pass binds
   its own.
 */
#ifndef SLOSH_GL_STATE_H
#define SLOSH_GL_STATE_H

enum { GL_STATE_CAPABILITIES = 10 };

/* Zero-initialise it. */
typedef struct GlState {
    int depth; /* how often it is kept, and not restored */
    int framebuffer, vertex_array, viewport[4];
    int clip_origin, clip_depth, depth_function, polygon_mode[2];
    int stencil[7]; /* function, reference, mask, three operations, mask of writing; of front faces */
    float depth_range[2], point_size;
    unsigned char depth_mask, color_mask[4];
    unsigned char enabled[GL_STATE_CAPABILITIES];
} GlState;

/* Keeps the context's state and makes it plain: all tests, blending, culling and what else changes or drops a
   fragment off, all masks open, depths from 0 to 1, points of one pixel. What is kept already is not asked
   for again: drivers that work behind the caller's back stand still for a question. The last restoring puts
   it back. */
void gl_state_keep(GlState *kept);
void gl_state_restore(GlState *kept);

#endif

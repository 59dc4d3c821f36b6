/* GL context state changed by a solver's draw passes: saved before and restored after, since the views draw
   in the same context. Texture units and programs are not included: every pass binds its own. */
#ifndef SLOSH_GL_STATE_H
#define SLOSH_GL_STATE_H

enum { GL_STATE_CAPABILITIES = 10 };

/* Zero-initialise. */
typedef struct GlState {
    int depth; /* nesting depth of gl_state_keep */
    int framebuffer, vertex_array, viewport[4];
    int clip_origin, clip_depth, depth_function, polygon_mode[2];
    int stencil[7]; /* function, reference, mask, three operations, write mask; of front faces */
    float depth_range[2], point_size;
    unsigned char depth_mask, color_mask[4];
    unsigned char enabled[GL_STATE_CAPABILITIES];
} GlState;

/* Saves the context's state and sets a plain state: tests, blending, culling and similar features off, all
   masks open, depths from 0 to 1, points of a pixel. Nested calls do not query the state again, since
   asynchronous drivers stall on queries. The outermost gl_state_restore restores the state. */
void gl_state_keep(GlState *kept);
void gl_state_restore(GlState *kept);

#endif

/* State known to the driver: settings of the context, and uniforms of the programs. Calls without effect are
   left out. A barrier waits for the next call beyond settings, together with all barriers up to there. For
   gl_calls.c, with functions between slosh and the driver. */
#ifndef SIM_GPU_GL_KNOWN_H
#define SIM_GPU_GL_KNOWN_H

#include <epoxy/gl.h>
#include <stdbool.h>
#include <stdint.h>

/* Call before and after functions that call the driver by pointers of their own. */
void gl_calls_foreign(void);

/* Settings by name, of up to four numbers. */
typedef enum KnownState {
    KNOWN_PROGRAM,
    KNOWN_VERTEX_ARRAY,
    KNOWN_VIEWPORT,
    KNOWN_SCISSOR,
    KNOWN_CLIP,
    KNOWN_DEPTH_FUNCTION,
    KNOWN_DEPTH_MASK,
    KNOWN_COLOR_MASK,
    KNOWN_BLEND,
    KNOWN_BLEND_EQUATION,
    KNOWN_CULLED,
    KNOWN_FRONT,
    KNOWN_DRAW_FRAMEBUFFER,
    KNOWN_READ_FRAMEBUFFER,
    KNOWN_STATES
} KnownState;

/* True if the context has these numbers; has them from now on. */
bool known_state(KnownState state, const uint32_t number[4]);
#define KNOWN(state, ...) known_state(KNOWN_##state, (const uint32_t[4]){__VA_ARGS__})

/* The same for capabilities, and for names bound to a target, to consecutive bindings (NULL: none), to
   units. */
bool known_capability(GLenum capability, bool enabled);
bool known_target(GLenum target, GLuint buffer);
bool known_framebuffer(GLenum target, GLuint framebuffer);
bool known_buffers(GLenum target, GLuint first, GLsizei count, const GLuint *buffers);
bool known_textures(GLuint first, GLsizei count, const GLuint *textures);

/* The same for `count` uniforms of `size` numbers of 4 bytes. */
bool known_uniform(GLuint program, GLint at, int size, GLsizei count, const void *numbers);

/* The program in use. */
GLuint known_program(void);

/* Unknown from now on; all return false. `names`: all bindings, since drivers give names anew. */
bool unknown_state(KnownState state);
bool unknown_capability(GLenum capability);
bool unknown_buffers(GLenum target, GLuint first, GLsizei count);
bool unknown_names(void);
bool unknown_uniforms(GLuint program);

/* For tests: all known state. A name of -1 is unknown. */
enum {
    KNOWN_CAPABILITIES = 24,
    KNOWN_TARGETS = 4,
    KNOWN_BINDINGS = 64,
    KNOWN_UNITS = 64,
    KNOWN_UNIFORMS = 4096
};

typedef struct Known {
    bool set[KNOWN_STATES];
    uint32_t number[KNOWN_STATES][4];
    struct {
        GLenum name;
        int enabled; /* 0: unknown, 1: no, 2: yes */
    } capability[KNOWN_CAPABILITIES];
    int64_t target[KNOWN_TARGETS], uniform_block[KNOWN_BINDINGS], storage[KNOWN_BINDINGS],
        texture[KNOWN_UNITS];
    struct {
        GLuint program;
        GLint at;
        int size; /* 0: empty */
        uint32_t number[4];
    } uniform[KNOWN_UNIFORMS]; /* a place for each hash: a newcomer drives out */
} Known;

const Known *known_all(void);

/* Forgets the context; `uniforms`: and all programs. */
void known_forget(bool uniforms);

#endif

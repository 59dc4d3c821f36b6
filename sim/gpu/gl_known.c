#include "sim/gpu/gl_known.h"

#include <stddef.h>
#include <string.h>

enum { UNKNOWN = -1 };

static Known known;

const Known *known_all(void)
{
    return &known;
}

bool known_state(KnownState state, const uint32_t number[4])
{
    if (known.set[state] && memcmp(known.number[state], number, sizeof known.number[state]) == 0)
        return true;
    memcpy(known.number[state], number, sizeof known.number[state]);
    known.set[state] = true;
    return false;
}

bool unknown_state(KnownState state)
{
    return known.set[state] = false;
}

/* NULL: no room is left. */
static int *capability_at(GLenum capability)
{
    for (int k = 0; k < KNOWN_CAPABILITIES; k++)
        if (known.capability[k].name == capability || known.capability[k].name == 0) {
            known.capability[k].name = capability;
            return &known.capability[k].enabled;
        }
    return NULL;
}

bool known_capability(GLenum capability, bool enabled)
{
    int *at = capability_at(capability);
    if (!at || *at == enabled + 1)
        return at;
    *at = enabled + 1;
    return false;
}

bool unknown_capability(GLenum capability)
{
    int *at = capability_at(capability);
    if (at)
        *at = 0;
    return false;
}

static bool known_name(int64_t *place, GLuint name)
{
    const bool same = *place == name;
    *place = name;
    return same;
}

bool known_target(GLenum target, GLuint buffer)
{
    static const GLenum targets[KNOWN_TARGETS] = {GL_DRAW_INDIRECT_BUFFER, GL_DISPATCH_INDIRECT_BUFFER,
                                                  GL_PIXEL_PACK_BUFFER, GL_PIXEL_UNPACK_BUFFER};
    for (int k = 0; k < KNOWN_TARGETS; k++)
        if (targets[k] == target)
            return known_name(&known.target[k], buffer);
    return false;
}

bool known_framebuffer(GLenum target, GLuint framebuffer)
{
    const uint32_t number[4] = {framebuffer};
    bool same = true;
    if (target != GL_READ_FRAMEBUFFER)
        same &= known_state(KNOWN_DRAW_FRAMEBUFFER, number);
    if (target != GL_DRAW_FRAMEBUFFER)
        same &= known_state(KNOWN_READ_FRAMEBUFFER, number);
    return same;
}

/* NULL: bindings of another kind. */
static int64_t *bindings_of(GLenum target, GLuint first, GLsizei count)
{
    int64_t *all = target == GL_UNIFORM_BUFFER          ? known.uniform_block
                   : target == GL_SHADER_STORAGE_BUFFER ? known.storage
                                                        : NULL;
    return all && first + (GLuint)count <= KNOWN_BINDINGS ? all + first : NULL;
}

static bool known_names(int64_t *places, GLsizei count, const GLuint *names)
{
    bool same = places != NULL;
    for (GLsizei k = 0; places && k < count; k++)
        same &= known_name(places + k, names ? names[k] : 0);
    return same;
}

bool known_buffers(GLenum target, GLuint first, GLsizei count, const GLuint *buffers)
{
    return known_names(bindings_of(target, first, count), count, buffers);
}

bool unknown_buffers(GLenum target, GLuint first, GLsizei count)
{
    int64_t *places = bindings_of(target, first, count);
    for (GLsizei k = 0; places && k < count; k++)
        places[k] = UNKNOWN;
    return false;
}

bool known_textures(GLuint first, GLsizei count, const GLuint *textures)
{
    return known_names(first + (GLuint)count <= KNOWN_UNITS ? known.texture + first : NULL, count, textures);
}

static bool known_numbers(GLuint program, GLint at, int size, const uint32_t *number)
{
    const size_t bytes = (size_t)size * sizeof *number,
                 place = (program * 0x9e3779b1U + (GLuint)at * 0x85ebca6bU) >> 20 & (KNOWN_UNIFORMS - 1);
    if (known.uniform[place].program == program && known.uniform[place].at == at &&
        known.uniform[place].size == size && memcmp(known.uniform[place].number, number, bytes) == 0)
        return true;
    known.uniform[place].program = program;
    known.uniform[place].at = at;
    known.uniform[place].size = size;
    memcpy(known.uniform[place].number, number, bytes);
    return false;
}

bool known_uniform(GLuint program, GLint at, int size, GLsizei count, const void *numbers)
{
    bool same = true;
    if (at < 0) /* OpenGL takes no notice */
        return true;
    if (program == 0) { /* unknown */
        memset(known.uniform, 0, sizeof known.uniform);
        return false;
    }
    for (GLsizei k = 0; k < count; k++)
        same &= known_numbers(program, at + k, size, (const uint32_t *)numbers + (ptrdiff_t)size * k);
    return same;
}

bool unknown_uniforms(GLuint program)
{
    for (int k = 0; k < KNOWN_UNIFORMS; k++)
        if (known.uniform[k].program == program)
            known.uniform[k].size = 0;
    return false;
}

GLuint known_program(void)
{
    return known.set[KNOWN_PROGRAM] ? known.number[KNOWN_PROGRAM][0] : 0;
}

bool unknown_names(void)
{
    static const KnownState bound[] = {KNOWN_VERTEX_ARRAY, KNOWN_DRAW_FRAMEBUFFER, KNOWN_READ_FRAMEBUFFER};
    for (size_t k = 0; k < sizeof bound / sizeof *bound; k++)
        known.set[bound[k]] = false;
    memset(known.target, UNKNOWN, sizeof known.target);
    memset(known.uniform_block, UNKNOWN, sizeof known.uniform_block);
    memset(known.storage, UNKNOWN, sizeof known.storage);
    memset(known.texture, UNKNOWN, sizeof known.texture);
    return false;
}

void known_forget(bool uniforms)
{
    memset(known.set, 0, sizeof known.set);
    memset(known.capability, 0, sizeof known.capability);
    unknown_names();
    if (uniforms)
        memset(known.uniform, 0, sizeof known.uniform);
}

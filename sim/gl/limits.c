#include "sim/gl/limits.h"

#include <epoxy/gl.h>
#include <stddef.h>
#include <unistd.h>

GlLimits gl_limits(void)
{
    GLint64 bytes = 0;
    GlLimits limits = {0};
    glGetIntegerv(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, &limits.compute_blocks);
    glGetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &limits.vertex_blocks);
    glGetIntegerv(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, &limits.bindings);
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    limits.block_bytes = bytes;
    return limits;
}

double gl_memory(void)
{
    GLint kib = 0;
    if (epoxy_has_gl_extension("GL_NVX_gpu_memory_info"))
        glGetIntegerv(GL_GPU_MEMORY_INFO_TOTAL_AVAILABLE_MEMORY_NVX, &kib);
    return kib > 0 ? 1024.0 * kib : (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
}

bool gl_limits_allow(const GlLimits *have, const GlNeeds *needs, Error *error)
{
    const GlLimits *least = &needs->least;
    const struct {
        const char *what;
        int least, have;
    } counts[] = {{"storage blocks in a compute shader", least->compute_blocks, have->compute_blocks},
                  {"storage blocks in a vertex shader", least->vertex_blocks, have->vertex_blocks},
                  {"bindings of storage buffers", least->bindings, have->bindings}};
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++)
        if (counts[k].have < counts[k].least)
            return error_set(error, "%s needs %d %s, and this driver has %d; %s", needs->who, counts[k].least,
                             counts[k].what, counts[k].have, needs->instead);
    if (have->block_bytes < least->block_bytes)
        return error_set(
            error,
            "%s needs a buffer of %lld bytes for this scene, and this driver allows shaders %lld; use a larger "
            "particles.spacing",
            needs->who, (long long)least->block_bytes, (long long)have->block_bytes);
    return true;
}

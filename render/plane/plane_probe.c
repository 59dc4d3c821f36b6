#include "render/plane/plane_probe.h"

#include <epoxy/gl.h>
#include <string.h>

static bool on_raster(const PlaneSum *sum, const int sample[2])
{
    return sample[0] >= 0 && sample[0] < sum->samples[0] && sample[1] >= 0 && sample[1] < sum->samples[1];
}

static void answer_at_once(PlaneProbe *probe, const PlaneSum *sum, const PlaneProbes *probes)
{
    probe->probes = *probes;
    memset(probe->sums, 0, sizeof probe->sums);
    for (int i = 0; i < probes->count; i++) {
        const int *sample = probes->sample[i];
        if (!on_raster(sum, sample))
            continue;
        const size_t at = (size_t)sample[1] * (size_t)sum->samples[0] + (size_t)sample[0];
        memcpy(probe->sums[i], sum->rows.out + 4 * at, sizeof probe->sums[i]);
    }
}

static void take(PlaneProbe *probe)
{
    const GLsync fence = probe->fence;
    if (!fence || glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, 0) == GL_TIMEOUT_EXPIRED)
        return;
    glDeleteSync(fence);
    probe->fence = NULL;
    probe->probes = probe->asked;
    glGetNamedBufferSubData(probe->buffer, 0, sizeof probe->sums, probe->sums);
}

static void ask(PlaneProbe *probe, const PlaneSum *sum, const PlaneProbes *probes)
{
    static const GLsizei size = sizeof(float[4]);
    if (!probe->buffer) {
        glCreateBuffers(1, &probe->buffer);
        glObjectLabel(GL_BUFFER, probe->buffer, -1, "slice probe");
        glNamedBufferStorage(probe->buffer, sizeof probe->sums, NULL, 0);
    }
    glClearNamedBufferData(probe->buffer, GL_R32F, GL_RED, GL_FLOAT, NULL);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, probe->buffer);
    for (int i = 0; i < probes->count; i++)
        if (on_raster(sum, probes->sample[i]))
            glGetTextureSubImage(sum->sums, 0, probes->sample[i][0], probes->sample[i][1], 0, 1, 1, 1,
                                 GL_RGBA, GL_FLOAT, size, (char *)NULL + (size_t)size * (size_t)i);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    probe->fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    probe->asked = *probes;
}

void plane_probe_ask(PlaneProbe *probe, const PlaneSum *sum, const PlaneProbes *probes)
{
    if (sum->by_rows) {
        answer_at_once(probe, sum, probes);
        return;
    }
    take(probe);
    if (!probe->fence && sum->sums)
        ask(probe, sum, probes);
}

void plane_probe_destroy(PlaneProbe *probe)
{
    glDeleteBuffers(1, &probe->buffer);
    glDeleteSync(probe->fence);
    *probe = (PlaneProbe){0};
}

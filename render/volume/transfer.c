#include "render/volume/transfer.h"

#include "shaders/volume/volume_bindings.h"

#include <epoxy/gl.h>
#include <math.h>

void transfer_fill(const ControlPoints *curve, const ControlPoints *opacity,
                   float table[4 * TRANSFER_ENTRIES])
{
    enum { PARTS = 64 };
    const double dx = 1.0 / (TRANSFER_ENTRIES - 1) / PARTS;
    double value = control_points_at(curve, 0), sum = 0, gone = fabs(value);
    for (int i = 0; i < TRANSFER_ENTRIES; i++) {
        for (int part = 0; i > 0 && part < PARTS; part++) {
            const double next = control_points_at(curve, ((i - 1) * PARTS + part + 1) * dx);
            sum += 0.5 * (value + next) * dx;
            gone += fabs(next - value);
            value = next;
        }
        table[4 * i] = (float)value;
        table[4 * i + 1] = (float)sum;
        table[4 * i + 2] = (float)gone;
        table[4 * i + 3] = (float)control_points_at(opacity, (double)i / (TRANSFER_ENTRIES - 1));
    }
}

void transfer_destroy(Transfer *transfer)
{
    glDeleteTextures(1, &transfer->texture);
    *transfer = (Transfer){.texture = 0};
}

static void create(Transfer *transfer)
{
    glCreateTextures(GL_TEXTURE_2D, 1, &transfer->texture);
    glObjectLabel(GL_TEXTURE, transfer->texture, -1, "transfer function");
    glTextureStorage2D(transfer->texture, 1, GL_RGBA32F, TRANSFER_ENTRIES, 1);
    glTextureParameteri(transfer->texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(transfer->texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(transfer->texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
}

void transfer_bind(Transfer *transfer, const ControlPoints *curve, const ControlPoints *opacity)
{
    const bool made = transfer->texture != 0;
    if (!made)
        create(transfer);
    if (!made || !control_points_equal(curve, &transfer->curve) ||
        !control_points_equal(opacity, &transfer->opacity)) {
        float table[4 * TRANSFER_ENTRIES];
        transfer_fill(curve, opacity, table);
        glTextureSubImage2D(transfer->texture, 0, 0, 0, TRANSFER_ENTRIES, 1, GL_RGBA, GL_FLOAT, table);
        transfer->curve = *curve;
        transfer->opacity = *opacity;
    }
    glBindTextureUnit(TRANSFER_UNIT, transfer->texture);
}

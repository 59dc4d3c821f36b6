// Smooths the rim between a pane of the box and the fluid's top, for render/views/splat/splat_private.h: a pixel belongs to the pane if most
// pixels around do. Thus single spheres that end before the wall, or reach the wall, leave no dots.
#include "common/frame.glsl"
#include "shaders/splat/splat_bindings.h"
#include "common/within_box.glsl"

layout(binding = NEAREST_UNIT) uniform sampler2D cut_map;     // output of panes.frag
layout(binding = TARGET_DEPTH_UNIT) uniform sampler2D own_map; // before cutting
layout(location = 0) out float cut;

const int TAPS = 12;
const float reach = 0.6; // spacings

bool is_none(ivec2 pixel)
{
    return texelFetch(cut_map, clamp(pixel, ivec2(0), ivec2(picture_size) - 1), 0).x >= 1e29;
}

bool is_pane(ivec2 pixel)
{
    return texelFetch(cut_map, clamp(pixel, ivec2(0), ivec2(picture_size) - 1), 0).x < 0.0;
}

// Software drivers only skip loops: rare work is in loops with mostly zero rounds.
void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float z = texelFetch(cut_map, pixel, 0).x;
    bool own = z < 0.0;
    int away = int(reach * particle_spacing * 0.5 * picture_size.y / (view_tangent.y * abs(z)));
    bool doubtful = is_pane(pixel + ivec2(away, 0)) != own || is_pane(pixel - ivec2(away, 0)) != own ||
                    is_pane(pixel + ivec2(0, away)) != own || is_pane(pixel - ivec2(0, away)) != own;
    int panes = int(own), rounds = doubtful && z < 1e29 ? TAPS : 0;
    for (int i = 0; i < rounds; i++) { // sunflower pattern: even over the disc
        float angle = 2.39996 * float(i), far = sqrt((float(i) + 1.0) / float(TAPS)) * float(away);
        panes += int(is_pane(pixel + ivec2(round(far * vec2(cos(angle), sin(angle))))));
    }
    cut = z;
    bool pane = 2 * panes > TAPS + 1;
    rounds = rounds > 0 && pane != own ? 1 : 0;
    for (int i = 0; i < rounds; i++) {
        float enter = within_box(ray_of_ndc(ndc_of_pixel(gl_FragCoord.xy))).enter;
        cut = !pane ? max(texelFetch(own_map, pixel, 0).x, enter) : enter > near_plane ? -enter : z;
    }
    // The far end of the top, at the wall behind: bumps are cut almost down to the line between.
    bool end = !own && z < 1e29 && (is_none(pixel + ivec2(0, away)) || is_none(pixel + ivec2(away, 0)) || is_none(pixel - ivec2(away, 0)));
    rounds = end ? 2 * TAPS : 0;
    int fluid = 1;
    for (int i = 0; i < rounds; i++) {
        float angle = 2.39996 * float(i), far = sqrt((float(i) + 1.0) / float(2 * TAPS)) * 1.2 * float(away);
        fluid += int(!is_none(pixel + ivec2(round(far * vec2(cos(angle), sin(angle))))));
    }
    // a little more than half
    rounds = end && float(fluid) < 0.56 * float(2 * TAPS + 1) ? 1 : 0;
    for (int i = 0; i < rounds; i++) {
        vec3 ray = ray_of_ndc(ndc_of_pixel(gl_FragCoord.xy));
        cut = (within_box(ray).leave - z) * length(ray) < 1.5 * particle_spacing ? 1e30 : cut;
    }
}

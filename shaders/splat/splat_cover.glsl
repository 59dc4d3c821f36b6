// The covered fraction of a pixel with spheres smaller than pixels, for shading with MIXING.
#include "shaders/splat/splat_bindings.h"
layout(location = COVER_STEP_AT) uniform float cover_step; // m: fluid farther behind is behind the pixel's spheres

// 1 for larger spheres. The rest of the pixel shows fluid farther behind, taken from two pixels beside; otherwise the target's
// content, but not amid fluid.
float cover_at(ivec2 pixel, float depth, inout vec3 albedo, inout vec3 normal)
{
    float sum = texelFetch(weight_map, pixel, 0).y;
    if (sum >= 1e8)
        return 1.0;
    float left = max(1.0 - 0.5 * sum, 0.0), cover = 1.0 - left * left; // near 1 - exp(-sum): spheres overlap
    int around = 0;
    for (int i = 0; i < 4; i++) {
        ivec2 offset = i < 2 ? ivec2(4 * i - 2, 0) : ivec2(0, 4 * i - 10);
        ivec2 beside = clamp(pixel + offset, ivec2(0), ivec2(picture_size) - 1);
        float z = abs(texelFetch(nearest_map, beside, 0).x), weight = texelFetch(weight_map, beside, 0).x;
        around += int(z < 1e29);
        if (z < 1e29 && z > depth + cover_step && weight > 0.0) {
            albedo = mix(texelFetch(color_map, beside, 0).rgb / weight, albedo, cover);
            normal = normalize(mix(normalize(texelFetch(normal_map, beside, 0).xyz), normal, cover));
            return 1.0;
        }
    }
    return around == 4 ? 1.0 : cover;
}

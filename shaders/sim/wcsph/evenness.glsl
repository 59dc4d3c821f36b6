// Sums for shifting, computed together with the forces: wcsph_range of sim/methods/wcsph/pairs_wcsph.c. Nothing without SHIFTING.
#ifdef SHIFTING
layout(std430, binding = UNEVENS_BUFFER) writeonly buffer Unevens { vec4 uneven[]; }; // see shift.comp

// Sums of F x_ij and F r^2, the same for an image, and sum of W.
vec4 even_sum = vec4(0), even_image = vec4(0);
float dense_sum = 1.0;

void even_meet(float f, vec3 d, float r2)
{
    even_sum += f * vec4(d, r2);
    dense_sum += height(sqrt(r2) * inverse_support);
}

void even_meet_image(float f, vec3 d, float r2)
{
    even_image += f * vec4(d, r2);
    dense_sum += height(sqrt(r2) * inverse_support);
}

void even_end_image(vec3 sign)
{
    even_sum += gradient_scale * even_image * vec4(sign, 1.0);
    even_image = vec4(0);
}

// complete_shift of sim/methods/wcsph/wcsph_passes.c.
void even_write(uint i)
{
    float share = clamp((even_sum.w / (float(dimensions) * rest_number_density) - 0.8) / 0.15, 0.0, 1.0);
    uneven[2u * i] = vec4(keep_notch(i, share * even_sum.xyz), share);
    uneven[2u * i + 1u] = vec4(kernel_scale * dense_sum / rest_number_density - 1.0, 0.0, 0.0, 0.0);
}
#else
#define even_meet(f, d, r2)
#define even_meet_image(f, d, r2)
#define even_end_image(sign)
#define even_write(i)
#endif

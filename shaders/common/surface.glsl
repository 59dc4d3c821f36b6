// What shadings of a smooth surface know of it in a pixel, and what they have in common. All in the eye's frame.
struct Surface {
    vec3 place; // m
    vec3 view;  // unit vector from the eye to it
    vec3 normal;
    vec3 albedo;
    float lit;       // what of the key light arrives through the fluid
    float key;       // and with solids in its way
    float thickness; // of the fluid on the ray, m; 0 with phong
};

float lobe_32(float cosine) // cosine^32
{
    cosine *= cosine, cosine *= cosine, cosine *= cosine, cosine *= cosine;
    return cosine * cosine;
}

// After: Phong, Illumination for computer generated pictures, 1975.
vec3 phong(Surface s)
{
    float to_light = dot(s.normal, light_in_eye);
    float glint = lobe_32(max(dot(2.0 * to_light * s.normal - light_in_eye, -s.view), 0.0));
    vec3 sky = ambient_light(s.normal) * (0.35 + 0.65 * s.lit);
    return s.albedo * sky + light_color * (s.key * (s.albedo * max(to_light, 0.0) + 0.35 * glint));
}

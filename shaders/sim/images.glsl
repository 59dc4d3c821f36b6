// The walls of the box as mirrors: sim/box/walls.c.
struct Image {
    vec3 x;
    vec3 sign; // -1 along mirrored axes, else 1
};

// End of the numbers of images. A number has base-three digits per axis: 0 no wall, 1 the lower wall, 2 the upper
// wall.
int images_end(vec3 x)
{
    vec3 centred = vec3(x.x, x.y - half_size.y, x.z), d = half_size - abs(centred);
#ifdef PERIODIC
    d = mix(d, vec3(support), periodic);
#endif
    if (dimensions == 2)
        return min(d.x, d.y) < support ? 9 : 1;
    return min(d.x, min(d.y, d.z)) < support ? 27 : 1;
}

// False if the image sees no fluid within h.
bool image_of(vec3 x, int walls, out Image image)
{
    ivec3 side = ivec3(walls % 3, walls / 3 % 3, walls / 9);
    bvec3 mirrored = greaterThan(side, ivec3(0)), upper = equal(side, ivec3(2));
    vec3 low = vec3(-half_size.x, 0.0, -half_size.z), high = low + 2.0 * half_size;
    vec3 d = max(mix(x - low, high - x, upper), 1e-3 * spacing), near = mix(vec3(0), d, mirrored);
    image.x = mix(x, mix(low - d, high + d, upper), mirrored);
    image.sign = mix(vec3(1), vec3(-1), mirrored);
#ifdef PERIODIC
    if (any(mirrored) && any(bvec3(mix(vec3(0), vec3(periodic), mirrored))))
        return false;
#endif
    return dot(near, near) < support * support;
}

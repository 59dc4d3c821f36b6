// walls_contain of sim/box/box.h.
bool in_the_box(vec3 x)
{
    vec3 low = vec3(-half_size.x, 0.0, -half_size.z), high = low + 2.0 * half_size;
    bool along_z = dimensions == 2 || (x.z >= low.z && x.z <= high.z);
    return x.x >= low.x && x.x <= high.x && x.y >= low.y && x.y <= high.y && along_z;
}

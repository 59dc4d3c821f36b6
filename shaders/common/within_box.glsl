// The part of a view ray inside the box: between the walls of entry and exit. Unlimited along an axis without walls. Needs
// common/frame.glsl.
struct Within {
    float enter, leave; // m along the eye's axis
    vec3 normal;        // normal of the wall of entry, towards the eye, in the eye's frame
    float slope;        // distance into the box across that wall per m along the eye's axis
};

Within within_box_of(vec3 ray, bvec3 walls) // `ray` has depth 1; `walls`: axes with walls
{
    vec3 low = vec3(-0.5, 0.0, -0.5) * box_size, high = low + box_size;
    low = mix(vec3(-1e30), low, walls), high = mix(vec3(1e30), high, walls);
    mat3 turn = mat3(box_to_eye);
    vec3 way = ray * turn, origin = -box_to_eye[3].xyz * turn; // transposed rotations are inverses
    bvec3 rising = greaterThanEqual(way, vec3(0.0));
    vec3 first = (mix(high, low, rising) - origin) / way, last = (mix(low, high, rising) - origin) / way;
    float enter = max(max(first.x, first.y), first.z);
    vec3 axis = first.x >= enter ? vec3(1.0, 0.0, 0.0) : first.y >= enter ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
    return Within(enter, min(min(last.x, last.y), last.z), turn * (axis * -sign(way)), dot(axis, abs(way)));
}

// Length of a ray inside the box from a place there, in lengths of `ray`. Periodic sides count as ends.
float way_in_box(vec3 place, vec3 ray)
{
    vec3 origin = (place - box_to_eye[3].xyz) * mat3(box_to_eye), way = ray * mat3(box_to_eye); // transposed rotations are inverses
    vec3 wall = mix(vec3(-0.5, 0.0, -0.5), vec3(0.5, 1.0, 0.5), greaterThanEqual(way, vec3(0.0))) * box_size;
    vec3 to = (wall - origin) / way;
    return max(min(min(to.x, to.y), to.z), 0.0);
}

Within within_box(vec3 ray)
{
    return within_box_of(ray, notEqual(walled & uvec3(1u, 2u, 4u), uvec3(0u)));
}

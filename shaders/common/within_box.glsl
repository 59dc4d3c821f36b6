// Where a view ray is in the box: between the walls that it enters and leaves by. An axis without walls has no end. Wants
// common/frame.glsl.
struct Within {
    float enter, leave; // m below the eye
    vec3 normal;        // of the wall that it enters by, towards the eye, in the eye's frame
    float slope;        // way into the box across that wall for each m below the eye
};

Within within_box_of(vec3 ray, bvec3 walls) // a ray of depth 1; with those axes' walls
{
    vec3 low = vec3(-0.5, 0.0, -0.5) * box_size, high = low + box_size;
    low = mix(vec3(-1e30), low, walls), high = mix(vec3(1e30), high, walls);
    mat3 turn = mat3(box_to_eye);
    vec3 way = ray * turn, origin = -box_to_eye[3].xyz * turn; // the inverse of a rotation
    bvec3 rising = greaterThanEqual(way, vec3(0.0));
    vec3 first = (mix(high, low, rising) - origin) / way, last = (mix(low, high, rising) - origin) / way;
    float enter = max(max(first.x, first.y), first.z);
    vec3 axis = first.x >= enter ? vec3(1.0, 0.0, 0.0) : first.y >= enter ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
    return Within(enter, min(min(last.x, last.y), last.z), turn * (axis * -sign(way)), dot(axis, abs(way)));
}

// How far a ray from a place in the box goes there, in its own lengths. Periodic sides end it too.
float way_in_box(vec3 place, vec3 ray)
{
    vec3 origin = (place - box_to_eye[3].xyz) * mat3(box_to_eye), way = ray * mat3(box_to_eye); // the inverse of a rotation
    vec3 wall = mix(vec3(-0.5, 0.0, -0.5), vec3(0.5, 1.0, 0.5), greaterThanEqual(way, vec3(0.0))) * box_size;
    vec3 to = (wall - origin) / way;
    return max(min(min(to.x, to.y), to.z), 0.0);
}

Within within_box(vec3 ray)
{
    return within_box_of(ray, notEqual(walled & uvec3(1u, 2u, 4u), uvec3(0u)));
}

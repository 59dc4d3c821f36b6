// As spheres.frag. What is beside the sphere gets the depth of nothing and fails the test of depth: cheaper than discard,
// as gl_PointCoord is than gl_FragCoord.
layout(location = 0) flat in vec3 along;
layout(location = 1) flat in vec3 across;
layout(location = 2) flat in vec3 depth;
layout(location = 3) flat in uint index;
layout(location = 0) out uint seen;

void main()
{
    float x = along.x + dot(along.yz, gl_PointCoord), y = across.x + dot(across.yz, gl_PointCoord);
    float e = 1.0 - x * x - y * y;
    gl_FragDepth = e < 0.0 ? 0.0 : depth.x + depth.y * x + depth.z * sqrt(e);
    seen = index;
}

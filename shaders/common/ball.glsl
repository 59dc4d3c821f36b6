// The ball that stands for a particle: of the view's radius, with DROPS of its own one, with ELLIPSOID that of an ellipsoid's volume
// (render/splat/ellipsoids.c). Wants common/frame.glsl and common/particles.glsl.
#include "shaders/shared/bindings.h"
#ifdef ELLIPSOID
// Of each: centre, radius of the ball of its volume, m; the symmetric matrix A that takes it to that ball, of determinant 1: xx yy
// zz, least axis in radii at most; xy xz yz.
layout(std430, binding = SHAPES_STORAGE) readonly buffer Shapes { vec4 shape[]; };
#elif defined DROPS
layout(std430, binding = SHAPES_STORAGE) readonly buffer Shapes { float shape_radius[]; };
#endif

struct Ball {
    vec3 centre; // in the box's frame
    float radius;
};

Ball ball_of(uint index)
{
#ifdef ELLIPSOID
    vec4 ball = shape[3u * index];
    return Ball(ball.xyz, ball.w);
#elif defined DROPS
    return Ball(particle_position(index), shape_radius[index]);
#elif defined THICKNESS
    return Ball(particle_position(index), splat_radius);
#else
    return Ball(particle_position(index), particle_radius);
#endif
}

// The ball that stands for a particle: of the view's radius, with DROPS of its own one, with ELLIPSOID that of an ellipsoid's volume,
// or of BALL_RADIUS where that is defined. Wants common/frame.glsl and common/particles.glsl.
#include "shaders/shared/bindings.h"
#ifndef BALL_RADIUS
#define BALL_RADIUS particle_radius // m
#endif
#if defined ELLIPSOID || defined APART
// Of each: centre, radius of the ball of its volume, m; the symmetric matrix A that takes it to that ball, of determinant 1: xx yy
// zz, least axis in radii at most; xy xz yz, how crowded it is around the particle, 0 .. 1.
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
#else
    return Ball(particle_position(index), BALL_RADIUS);
#endif
}

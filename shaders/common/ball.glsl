// The ball of a particle: with the view's radius; with DROPS, a radius per particle; with ELLIPSOID, the ball with the
// ellipsoid's volume; or with BALL_RADIUS, if defined. Needs common/frame.glsl and common/particles.glsl.
#include "shaders/shared/bindings.h"
#ifndef BALL_RADIUS
#define BALL_RADIUS particle_radius // m
#endif
#if defined ELLIPSOID || defined APART
// Per particle: centre and radius (m) of the ball of equal volume. Then the symmetric matrix A, of determinant 1, that maps the
// ellipsoid to this ball. In order: xx yy zz, upper bound of the least axis in radii; xy xz yz, crowding around the particle, 0 .. 1.
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

#include "sim/box/box.h"

static bool equal(const double *a, const double *b, int count)
{
    for (int k = 0; k < count; k++)
        if (a[k] != b[k])
            return false;
    return true;
}

static bool same_pose_at_rest(const BoxState *begin, const BoxState *end)
{
    static const double zero[3] = {0};
    return equal(begin->position, end->position, 3) && equal(begin->orientation, end->orientation, 4) &&
           equal(begin->velocity, zero, 3) && equal(begin->angular_velocity, zero, 3) &&
           equal(end->velocity, zero, 3) && equal(end->angular_velocity, zero, 3);
}

static void store(const double v[3], float out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = (float)v[k];
}

/* D = R1^T R0 - I from the quaternion d = conj(q1) q0, without cancellation: with d = (u, w),
   D y = 2 w (u x y) + 2 u x (u x y). */
static void rotation_less_identity(const double q1[4], const double q0[4], float out[3][3])
{
    const double *a = q1, *b = q0;
    const double u[3] = {
        a[3] * b[0] - a[0] * b[3] - (a[1] * b[2] - a[2] * b[1]),
        a[3] * b[1] - a[1] * b[3] - (a[2] * b[0] - a[0] * b[2]),
        a[3] * b[2] - a[2] * b[3] - (a[0] * b[1] - a[1] * b[0]),
    };
    const double w = a[3] * b[3] + a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const double uu = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[i][j] = (float)(2 * (u[i] * u[j] - (i == j ? uu : 0)));
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3; /* (u x y)_i = u_j y_k - u_k y_j, cyclic */
        out[i][k] = (float)(2 * (u[i] * u[k] + w * u[j]));
        out[j][k] = (float)(2 * (u[j] * u[k] - w * u[i]));
    }
}

void box_step(const BoxState *begin, const BoxState *end, double dt, BoxStep *step)
{
    *step = (BoxStep){.still = same_pose_at_rest(begin, end), .dt = (float)dt};
    if (step->still)
        return;

    double shift[3], change[3], out[3];
    for (int k = 0; k < 3; k++) {
        shift[k] = end->position[k] - begin->position[k] - begin->velocity[k] * dt;
        change[k] = end->velocity[k] - begin->velocity[k];
    }
    quat_rotate_inverse(begin->orientation, shift, out);
    store(out, step->shift);
    quat_rotate_inverse(end->orientation, change, out);
    store(out, step->velocity_change);
    quat_rotate_inverse(begin->orientation, begin->angular_velocity, out);
    store(out, step->omega0);
    quat_rotate_inverse(end->orientation, end->angular_velocity, out);
    store(out, step->omega1);
    rotation_less_identity(end->orientation, begin->orientation, step->rotation);
}

void apparent_gravity(const double gravity[3], const BoxState *begin, const BoxState *middle,
                      const BoxState *end, double dt, ApparentGravity *out)
{
    double apparent[3], alpha[3], axes[3];
    for (int k = 0; k < 3; k++) {
        apparent[k] = gravity[k] - (end->velocity[k] - begin->velocity[k]) / dt;
        alpha[k] = (end->angular_velocity[k] - begin->angular_velocity[k]) / dt;
    }
    quat_rotate_inverse(middle->orientation, apparent, axes);
    store(axes, out->origin);
    quat_rotate_inverse(middle->orientation, alpha, axes);
    store(axes, out->alpha);
    quat_rotate_inverse(middle->orientation, middle->angular_velocity, axes);
    store(axes, out->omega);
}

#include "sim/mesh/mesh_shape.h"
#include "sim/solids/solid.h"

#include <math.h>
#include <string.h>

/* ---- hull ---- */

enum { RIM = 32, SHELL = 96, DIRECTIONS = BODY_POINTS, EDGE = 3 };

static void put(BodyHull *hull, double x, double y, double z)
{
    double *to = hull->point[hull->count++];
    to[0] = x, to[1] = y, to[2] = z;
}

/* The corners, and EDGE points between neighbouring corners; `flat`: a rectangle. */
static void hull_of_box(BodyHull *hull, const double size[3], bool flat)
{
    enum { STEPS = EDGE + 1 };
    const int deep = flat ? 0 : STEPS;
    for (int i = 0; i <= STEPS; i++)
        for (int j = 0; j <= STEPS; j++)
            for (int k = 0; k <= deep; k++) {
                const int ends = (i % STEPS == 0) + (j % STEPS == 0) + (!flat && k % STEPS == 0);
                if (ends >= (flat ? 1 : 2))
                    put(hull, size[0] * ((double)i / STEPS - 0.5), size[1] * ((double)j / STEPS - 0.5),
                        flat ? 0 : size[2] * ((double)k / STEPS - 0.5));
            }
}

static void put_rim(BodyHull *hull, double radius, double y)
{
    for (int i = 0; i < RIM; i++)
        put(hull, radius * cos(2 * M_PI * i / RIM), y, radius * sin(2 * M_PI * i / RIM));
}

static void direction(int i, int count, double low, double out[3])
{
    const double y = low + (1 - low) * (i + 0.5) / count, across = sqrt(1 - y * y),
                 angle = M_PI * (3 - sqrt(5)) * i;
    out[0] = across * cos(angle), out[1] = y, out[2] = across * sin(angle);
}

static void hull_of_bowl(BodyHull *hull, double outer, bool flat)
{
    if (flat) {
        for (int i = 0; i <= RIM; i++)
            put(hull, outer * cos(M_PI * i / RIM), -outer * sin(M_PI * i / RIM), 0);
        return;
    }
    put_rim(hull, outer, 0);
    for (int i = 0; i < SHELL; i++) {
        double d[3];
        direction(i, SHELL, 0, d);
        put(hull, outer * d[0], -outer * d[1], outer * d[2]);
    }
}

static bool has(const BodyHull *hull, const double x[3])
{
    for (int i = 0; i < hull->count; i++)
        if (hull->point[i][0] == x[0] && hull->point[i][1] == x[1] && hull->point[i][2] == x[2])
            return true;
    return false;
}

static void hull_of_mesh(BodyHull *hull, const MeshUse *mesh)
{
    const Triangles *all = &mesh->shape->triangles;
    for (int i = 0; i < DIRECTIONS; i++) {
        double d[3], most = -INFINITY, x[3] = {0};
        size_t best = 0;
        direction(i, DIRECTIONS, -1, d);
        for (size_t v = 0; v < all->vertex_count; v++) {
            const float *at = all->vertex[v];
            const double along = d[0] * (double)at[0] + d[1] * (double)at[1] + d[2] * (double)at[2];
            best = along > most ? v : best;
            most = fmax(most, along);
        }
        for (int k = 0; k < 3; k++)
            x[k] = mesh->scale * (double)all->vertex[best][k];
        if (!has(hull, x))
            put(hull, x[0], x[1], x[2]);
    }
}

void body_hull(const SolidDef *solid, int dimensions, BodyHull *hull)
{
    const bool flat = dimensions == 2;
    *hull = (BodyHull){.count = 0};
    switch (solid->kind) {
    case SOLID_BOX:
        hull_of_box(hull, solid->size, flat);
        break;
    case SOLID_CYLINDER:
        put_rim(hull, solid->radius, -0.5 * solid->height);
        put_rim(hull, solid->radius, 0.5 * solid->height);
        break;
    case SOLID_BOWL:
        hull_of_bowl(hull, solid->radius + solid->thickness, flat);
        break;
    case SOLID_MESH:
        hull_of_mesh(hull, &solid->mesh);
        break;
    default:
        put(hull, 0, 0, 0);
        hull->radius = solid->radius;
    }
}

/* ---- mass ---- */

static void moments_of_ball(Moments *m, double r, bool flat)
{
    m->volume = flat ? M_PI * r * r : 4 * M_PI / 3 * pow(r, 3);
    for (int k = 0; k < 3; k++)
        m->second[k][k] = m->volume * r * r / (flat ? 4 : 5);
}

static void moments_of_box(Moments *m, const double size[3], bool flat)
{
    m->volume = size[0] * size[1] * (flat ? 1 : size[2]);
    for (int k = 0; k < 3; k++)
        m->second[k][k] = m->volume * size[k] * size[k] / 12;
}

static void moments_of_cylinder(Moments *m, double r, double height)
{
    m->volume = M_PI * r * r * height;
    m->second[0][0] = m->second[2][2] = m->volume * r * r / 4;
    m->second[1][1] = m->volume * height * height / 12;
}

/* Adds `sign` times the half y < 0 of a ball or disc. */
static void add_half_ball(Moments *m, double r, bool flat, double sign)
{
    Moments whole = {0};
    moments_of_ball(&whole, r, flat);
    m->volume += sign * 0.5 * whole.volume;
    m->first[1] -= sign * (flat ? 2 * pow(r, 3) / 3 : M_PI * pow(r, 4) / 4);
    for (int k = 0; k < 3; k++)
        m->second[k][k] += sign * 0.5 * whole.second[k][k];
}

/* Adds the tetrahedron of the origin and a triangle: positive volume if the normal points away from the
   origin. */
static void add_tetrahedron(Moments *m, const double a[3], const double b[3], const double c[3])
{
    double across[3];
    cross_product(b, c, across);
    const double six = a[0] * across[0] + a[1] * across[1] + a[2] * across[2];
    m->volume += six / 6;
    for (int i = 0; i < 3; i++) {
        m->first[i] += six / 24 * (a[i] + b[i] + c[i]);
        for (int j = 0; j < 3; j++)
            m->second[i][j] +=
                six / 120 *
                ((a[i] + b[i] + c[i]) * (a[j] + b[j] + c[j]) + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]);
    }
}

/* Volumes within several parts of a mesh count once. */
static void take_excess(Moments *m, const Moments *excess, double scale)
{
    m->volume -= pow(scale, 3) * excess->volume;
    for (int i = 0; i < 3; i++) {
        m->first[i] -= pow(scale, 4) * excess->first[i];
        for (int j = 0; j < 3; j++)
            m->second[i][j] -= pow(scale, 5) * excess->second[i][j];
    }
}

static void moments_of_mesh(Moments *m, const MeshUse *mesh)
{
    const Triangles *all = &mesh->shape->triangles;
    for (size_t t = 0; t < all->triangle_count; t++) {
        double corner[3][3];
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++)
                corner[v][k] = mesh->scale * (double)all->vertex[all->triangle[t][v]][k];
        add_tetrahedron(m, corner[0], corner[1], corner[2]);
    }
    take_excess(m, &mesh->shape->excess, mesh->scale);
}

static void moments_of(const SolidDef *solid, bool flat, Moments *m)
{
    memset(m, 0, sizeof *m);
    switch (solid->kind) {
    case SOLID_BOX:
        moments_of_box(m, solid->size, flat);
        break;
    case SOLID_CYLINDER:
        moments_of_cylinder(m, solid->radius, solid->height);
        break;
    case SOLID_BOWL:
        add_half_ball(m, solid->radius + solid->thickness, flat, 1);
        add_half_ball(m, solid->radius, flat, -1);
        break;
    case SOLID_MESH:
        moments_of_mesh(m, &solid->mesh);
        break;
    default:
        moments_of_ball(m, solid->radius, flat);
    }
}

/* Turns the matrix in the plane of axes p and q so that a[p][q] becomes 0, and turns `axes` along. */
static void turn_away(double a[3][3], int p, int q, double axes[4])
{
    if (a[p][q] == 0)
        return;
    const double angle = 0.5 * atan2(2 * a[p][q], a[q][q] - a[p][p]), c = cos(angle), s = sin(angle);
    for (int k = 0; k < 3; k++) {
        const double kp = a[k][p], kq = a[k][q];
        a[k][p] = c * kp - s * kq, a[k][q] = s * kp + c * kq;
    }
    for (int k = 0; k < 3; k++) {
        const double pk = a[p][k], qk = a[q][k];
        a[p][k] = c * pk - s * qk, a[q][k] = s * pk + c * qk;
    }
    /* The new axes: p' = c p - s q, q' = s p + c q, a turn about the third axis. */
    double turn[4] = {0, 0, 0, cos(0.5 * angle)};
    turn[3 - p - q] = (q == (p + 1) % 3 ? -1 : 1) * sin(0.5 * angle);
    quat_multiply(axes, turn, axes);
}

/* Jacobi rotations: a few sweeps make the matrix diagonal to the last digit. */
static void to_principal(double a[3][3], double axes[4])
{
    axes[0] = axes[1] = axes[2] = 0, axes[3] = 1;
    for (int sweep = 0; sweep < 12; sweep++)
        for (int p = 0; p < 2; p++)
            for (int q = p + 1; q < 3; q++)
                turn_away(a, p, q, axes);
}

/* A disc of radius a, moving along the axis, carries 8 a^3 / 3 of fluid along (Lamb, "Hydrodynamics", article
   102). In two dimensions a plate of width 2 a carries pi a^2. `broad` is half of the carried volume. The
   disc has the area of the greatest face of the block with the body's inertia. */
static void extents(const double second[3][3], bool flat, BodyMass *mass)
{
    double length[3], most = 0;
    mass->area = 0;
    for (int k = 0; k < 3; k++)
        length[k] = sqrt(12 * second[k][k] / mass->volume);
    for (int k = 0; k < 3; k++) {
        const double face = length[k] * length[(k + 1) % 3];
        most = fmax(most, face);
        mass->area += 2 * face;
    }
    mass->broad = 4.0 / 3 * pow(most / M_PI, 1.5);
    if (flat) {
        mass->area = 2 * (length[0] + length[1]);
        mass->broad = M_PI / 8 * pow(fmax(length[0], length[1]), 2);
    }
}

void body_mass(const SolidDef *solid, int dimensions, BodyMass *mass)
{
    const bool flat = dimensions == 2;
    Moments m;
    moments_of(solid, flat, &m);
    mass->volume = m.volume;
    mass->mass = solid->density * m.volume;
    for (int i = 0; i < 3; i++)
        mass->centre[i] = m.first[i] / m.volume;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            m.second[i][j] -= m.volume * mass->centre[i] * mass->centre[j];
    if (flat) {
        extents((const double(*)[3])m.second, flat, mass);
        mass->axes[0] = mass->axes[1] = mass->axes[2] = 0, mass->axes[3] = 1;
        for (int k = 0; k < 3; k++)
            mass->inertia[k] = solid->density * (m.second[0][0] + m.second[1][1]);
        return;
    }
    to_principal(m.second, mass->axes);
    extents((const double(*)[3])m.second, flat, mass);
    for (int k = 0; k < 3; k++)
        mass->inertia[k] =
            solid->density * (m.second[(k + 1) % 3][(k + 1) % 3] + m.second[(k + 2) % 3][(k + 2) % 3]);
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Sets position and velocity of the frame so that the hinge point rests. */
static void hang(const Body *body, BodyState *state)
{
    double arm[3], swirl[3];
    quat_rotate(state->pose.orientation, body->arm, arm);
    cross_product(state->pose.angular_velocity, arm, swirl);
    for (int k = 0; k < 3; k++) {
        state->pose.position[k] = body->at[k] - arm[k];
        state->pose.velocity[k] = -swirl[k];
    }
}

/* Inertia about the centre of mass times w, in the box's axes; `inverse`: inverse inertia times w. */
static void inertia_times(const Body *body, const double orientation[4], bool inverse, const double w[3],
                          double out[3])
{
    double axes[4], own[3];
    quat_multiply(orientation, body->mass.axes, axes);
    quat_rotate_inverse(axes, w, own);
    for (int k = 0; k < 3; k++)
        own[k] = inverse ? own[k] / body->mass.inertia[k] : own[k] * body->mass.inertia[k];
    quat_rotate(axes, own, out);
}

/* Centre of mass, box's frame, m. */
static void body_centre(const Body *body, const BodyState *state, double centre[3])
{
    quat_rotate(state->pose.orientation, body->mass.centre, centre);
    for (int k = 0; k < 3; k++)
        centre[k] += state->pose.position[k];
}

/* The body's tensor sum m x x about the centre is half the trace of the inertia, less the inertia. */
void body_sums(const Body *body, const BodyState *state, EnergySums *sums)
{
    const double *I = body->mass.inertia, *w = state->pose.angular_velocity;
    const double half = 0.5 * (I[0] + I[1] + I[2]);
    double centre[3], v[3], turned[3], axes[4];
    body_centre(body, state, centre);
    body_velocity(&state->pose, centre, v);
    energy_sums_add(sums, body->mass.mass, centre, v);
    energy_sums_add_turning(sums, body->mass.mass, centre, v);
    inertia_times(body, state->pose.orientation, false, w, turned);
    sums->own += 0.5 * dot(w, turned);
    quat_multiply(state->pose.orientation, body->mass.axes, axes);
    for (int k = 0; k < 3; k++) {
        double axis[3] = {k == 0, k == 1, k == 2}, in_box[3];
        quat_rotate(axes, axis, in_box);
        for (int i = 0; i < 3; i++) {
            sums->second[i] += (half - I[k]) * in_box[i] * in_box[i];
            sums->second[3 + i] += (half - I[k]) * in_box[i] * in_box[(i + 1) % 3];
        }
        sums->turn[k] += turned[k];
    }
}

static void hinge_make(Body *body, const BodyState *rest)
{
    const double length = sqrt(dot(body->def.hinge_axis, body->def.hinge_axis));
    double centre[3], arm[3], turned[3];
    body->hinged = length > 0;
    if (!body->hinged)
        return;
    for (int k = 0; k < 3; k++) {
        body->at[k] = body->def.hinge_at[k];
        body->axis[k] = body->def.hinge_axis[k] / length;
        arm[k] = body->at[k] - rest->pose.position[k];
    }
    quat_rotate_inverse(rest->pose.orientation, arm, body->arm);
    body_centre(body, rest, centre);
    for (int k = 0; k < 3; k++)
        arm[k] = centre[k] - body->at[k];
    inertia_times(body, rest->pose.orientation, false, body->axis, turned);
    const double along = dot(arm, body->axis);
    body->about = dot(turned, body->axis) + body->mass.mass * (dot(arm, arm) - along * along);
}

void body_make(Body *body, const SolidDef *solid, int dimensions)
{
    BodyState rest;
    memset(body, 0, sizeof *body);
    body->def = *solid;
    body_mass(solid, dimensions, &body->mass);
    body_hull(solid, dimensions, &body->hull);
    memset(&rest, 0, sizeof rest);
    solid_pose(&body->def, 0, &rest.pose);
    hinge_make(body, &rest);
}

void body_velocity(const BoxState *pose, const double x[3], double v[3])
{
    const double arm[3] = {x[0] - pose->position[0], x[1] - pose->position[1], x[2] - pose->position[2]};
    cross_product(pose->angular_velocity, arm, v);
    for (int k = 0; k < 3; k++)
        v[k] += pose->velocity[k];
}

/* ---- flight ---- */

/* Turns about principal axis k for a time; component k of the angular momentum L stays constant. */
static void turn_about(int k, double time, const double inertia[3], double L[3], double axes[4])
{
    const double angle = time * L[k] / inertia[k], c = cos(angle), s = sin(angle);
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double Li = L[i], Lj = L[j];
    double turn[4] = {0, 0, 0, cos(0.5 * angle)};
    turn[k] = sin(0.5 * angle);
    quat_multiply(axes, turn, axes);
    L[i] = c * Li + s * Lj;
    L[j] = c * Lj - s * Li;
}

/* Advances the solid's orientation and angular velocity in the world by a free rotation over `time`. */
static void turn_freely(const BodyMass *mass, double time, double orientation[4], double w[3])
{
    static const int order[] = {0, 1, 2, 1, 0};
    static const double part[] = {0.5, 0.5, 1, 0.5, 0.5};
    double axes[4], back[4] = {-mass->axes[0], -mass->axes[1], -mass->axes[2], mass->axes[3]}, L[3];
    quat_multiply(orientation, mass->axes, axes);
    quat_rotate_inverse(axes, w, L);
    for (int k = 0; k < 3; k++)
        L[k] *= mass->inertia[k];
    for (int i = 0; i < 5; i++)
        turn_about(order[i], part[i] * time, mass->inertia, L, axes);
    for (int k = 0; k < 3; k++)
        L[k] /= mass->inertia[k];
    quat_rotate(axes, L, w);
    const double norm = sqrt(axes[0] * axes[0] + axes[1] * axes[1] + axes[2] * axes[2] + axes[3] * axes[3]);
    for (int k = 0; k < 4; k++)
        axes[k] /= norm;
    quat_multiply(axes, back, orientation);
}

static void world_to_box(const BoxState *box, const double x_world[3], const double v_world[3], double x[3],
                         double v[3])
{
    double arm[3], swirl[3], out[3];
    for (int k = 0; k < 3; k++)
        arm[k] = x_world[k] - box->position[k];
    cross_product(box->angular_velocity, arm, swirl);
    for (int k = 0; k < 3; k++)
        out[k] = v_world[k] - box->velocity[k] - swirl[k];
    quat_rotate_inverse(box->orientation, arm, x);
    quat_rotate_inverse(box->orientation, out, v);
}

static void fly(const Body *body, const BoxState *begin, const BoxState *end, double dt, BodyState *state)
{
    BoxState *pose = &state->pose;
    double centre[3], v[3], x_world[3], v_world[3], w[3], world[4], arm[3];
    body_centre(body, state, centre);
    body_velocity(pose, centre, v);
    box_to_world(begin, centre, v, x_world, v_world);
    quat_rotate(begin->orientation, pose->angular_velocity, w);
    quat_multiply(begin->orientation, pose->orientation, world);
    for (int k = 0; k < 3; k++) {
        w[k] += begin->angular_velocity[k];
        x_world[k] += dt * v_world[k];
    }
    turn_freely(&body->mass, dt, world, w);
    const double back[4] = {-end->orientation[0], -end->orientation[1], -end->orientation[2],
                            end->orientation[3]};
    quat_multiply(back, world, pose->orientation);
    for (int k = 0; k < 3; k++)
        w[k] -= end->angular_velocity[k];
    quat_rotate_inverse(end->orientation, w, pose->angular_velocity);
    world_to_box(end, x_world, v_world, centre, v);
    quat_rotate(pose->orientation, body->mass.centre, arm);
    for (int k = 0; k < 3; k++)
        pose->position[k] = centre[k] - arm[k];
    double swirl[3];
    cross_product(pose->angular_velocity, arm, swirl);
    for (int k = 0; k < 3; k++)
        pose->velocity[k] = v[k] - swirl[k];
}

void body_drift(const Body *body, const BoxState *begin, const BoxState *end, double dt, BodyState *state)
{
    if (!body->hinged) {
        fly(body, begin, end, dt, state);
        return;
    }
    double turn[3];
    for (int k = 0; k < 3; k++)
        turn[k] = dt * state->pose.angular_velocity[k];
    quat_turn(turn, state->pose.orientation);
    hang(body, state);
}

/* ---- kicks ---- */

/* Changes the velocity of the centre of mass by dv, the angular velocity by dw. */
static void change(const Body *body, const double dv[3], const double dw[3], BodyState *state)
{
    double arm[3], swirl[3];
    quat_rotate(state->pose.orientation, body->mass.centre, arm);
    cross_product(dw, arm, swirl);
    for (int k = 0; k < 3; k++) {
        state->pose.angular_velocity[k] += dw[k];
        state->pose.velocity[k] += dv[k] - swirl[k];
    }
}

/* M / m, see sim/solids/solid.h. */
static double carried(const Body *body, const BodyFluid *fluid, const Push *push, double dt)
{
    static const double WET = 0.25;
    const BodyMass *mass = &body->mass;
    const double way = fluid->sound * dt, weight = fluid->density * mass->volume * fluid->gravity;
    const double force = sqrt(dot(push->force, push->force)) / dt;
    const double share = force < WET * weight ? force / (WET * weight) : 1;
    if (fluid->sound > 0)
        return share * fmax(fluid->density * mass->area * way * way / (fluid->reach * mass->mass) - 1, 0);
    return share * fluid->density * fmax(mass->volume, mass->broad) / mass->mass;
}

static void push_free(const Body *body, double s, const Push *push, double dt, BodyState *state)
{
    const double m = body->mass.mass;
    double arm[3], dv[3], dw[3], turned[3];
    Push of_centre = *push;
    quat_rotate(state->pose.orientation, body->mass.centre, arm);
    push_about(&of_centre, arm);
    inertia_times(body, state->pose.orientation, true, of_centre.torque, turned);
    for (int k = 0; k < 3; k++) {
        state->push[k] = (of_centre.force[k] / (m * dt) + s * state->push[k]) / (1 + s);
        state->twist[k] = (turned[k] / dt + s * state->twist[k]) / (1 + s);
        dv[k] = dt * state->push[k];
        dw[k] = dt * state->twist[k];
    }
    change(body, dv, dw, state);
}

static void push_hinged(const Body *body, double s, const Push *push, double dt, BodyState *state)
{
    double arm[3];
    Push about = *push;
    quat_rotate(state->pose.orientation, body->arm, arm);
    push_about(&about, arm);
    const double turned = dot(body->axis, about.torque) / (body->about * dt);
    state->twist[0] = (turned + s * state->twist[0]) / (1 + s);
    for (int k = 0; k < 3; k++)
        state->pose.angular_velocity[k] += dt * state->twist[0] * body->axis[k];
    hang(body, state);
}

void body_push(const Body *body, const BodyFluid *fluid, const Push *push, double dt, BodyState *state)
{
    Push all = *push;
    push_add(&all, 1, &state->left);
    const double s = carried(body, fluid, &all, dt);
    state->left = (Push){.force = {0}};
    if (body->hinged)
        push_hinged(body, s, &all, dt, state);
    else
        push_free(body, s, &all, dt, state);
}

/* Torque about the hinge axis by gravity and the box's motion, for a body carried by the box, N m. */
static double apparent_torque(const Body *body, const ApparentGravity *apparent, const BodyState *state)
{
    const double *w = state->pose.angular_velocity;
    double centre[3], arm[3], v[3], coriolis[3], force[3], turn[3], omega[3], alpha[3], all[3], L[3];
    float x[3], g[3];
    body_centre(body, state, centre);
    body_velocity(&state->pose, centre, v);
    for (int k = 0; k < 3; k++) {
        x[k] = (float)centre[k];
        arm[k] = centre[k] - body->at[k];
        omega[k] = (double)apparent->omega[k];
        alpha[k] = (double)apparent->alpha[k];
        all[k] = omega[k] + w[k];
    }
    apparent_gravity_at(apparent, x, g);
    cross_product(omega, v, coriolis);
    for (int k = 0; k < 3; k++)
        force[k] = body->mass.mass * ((double)g[k] - 2 * coriolis[k]);
    cross_product(arm, force, turn);
    double torque = dot(body->axis, turn);
    cross_product(omega, w, coriolis);
    for (int k = 0; k < 3; k++)
        coriolis[k] += alpha[k];
    inertia_times(body, state->pose.orientation, false, coriolis, turn);
    torque -= dot(body->axis, turn);
    inertia_times(body, state->pose.orientation, false, all, L);
    cross_product(all, L, turn);
    return torque - dot(body->axis, turn);
}

void body_start(const Body *body, const double gravity[3], BodyState *state)
{
    ApparentGravity apparent = {.origin = {0}};
    memset(state, 0, sizeof *state);
    solid_pose(&body->def, 0, &state->pose);
    for (int k = 0; k < 3; k++) {
        apparent.origin[k] = (float)gravity[k];
        state->push[k] = body->hinged ? 0 : -gravity[k];
    }
    if (body->hinged)
        state->twist[0] = -apparent_torque(body, &apparent, state) / body->about;
}

void body_fall(const Body *body, const double gravity[3], const ApparentGravity *apparent, double dt,
               BodyState *state)
{
    if (!body->hinged) {
        for (int k = 0; k < 3; k++)
            state->pose.velocity[k] += dt * gravity[k];
        return;
    }
    const double faster = dt * apparent_torque(body, apparent, state) / body->about;
    for (int k = 0; k < 3; k++)
        state->pose.angular_velocity[k] += faster * body->axis[k];
    hang(body, state);
}

void body_rates(const Body *body, const ApparentGravity *apparent, const BodyState *state, double change[3],
                double alpha[3])
{
    const double *w = state->pose.angular_velocity;
    double arm[3], swirl[3], inward[3];
    if (body->hinged) {
        const double rate = state->twist[0] + apparent_torque(body, apparent, state) / body->about;
        quat_rotate(state->pose.orientation, body->arm, arm);
        for (int k = 0; k < 3; k++) {
            change[k] = 0;
            alpha[k] = rate * body->axis[k];
        }
    } else {
        double centre[3];
        float x[3], g[3];
        body_centre(body, state, centre);
        quat_rotate(state->pose.orientation, body->mass.centre, arm);
        for (int k = 0; k < 3; k++)
            x[k] = (float)centre[k];
        apparent_gravity_at(apparent, x, g);
        for (int k = 0; k < 3; k++) {
            change[k] = state->push[k] + (double)g[k];
            alpha[k] = state->twist[k] - (double)apparent->alpha[k];
        }
    }
    cross_product(alpha, arm, swirl); /* from the centre of mass or hinge to the frame */
    cross_product(w, arm, inward);
    cross_product(w, inward, inward);
    for (int k = 0; k < 3; k++)
        change[k] -= swirl[k] + inward[k];
}

void body_hit(const Body *body, const double x[3], const double blow[3], BodyState *state)
{
    const double *from = body->at;
    double centre[3], arm[3], turn[3], dv[3], dw[3];
    if (!body->hinged) {
        body_centre(body, state, centre);
        from = centre;
    }
    for (int k = 0; k < 3; k++)
        arm[k] = x[k] - from[k];
    cross_product(arm, blow, turn);
    if (body->hinged) {
        for (int k = 0; k < 3; k++)
            state->pose.angular_velocity[k] += dot(body->axis, turn) / body->about * body->axis[k];
        hang(body, state);
        return;
    }
    inertia_times(body, state->pose.orientation, true, turn, dw);
    for (int k = 0; k < 3; k++)
        dv[k] = blow[k] / body->mass.mass;
    change(body, dv, dw, state);
}

double body_yield(const Body *body, const BodyState *state, const double x[3], const double n[3])
{
    double v[3];
    BodyState hit = *state;
    memset(hit.pose.velocity, 0, sizeof hit.pose.velocity);
    memset(hit.pose.angular_velocity, 0, sizeof hit.pose.angular_velocity);
    body_hit(body, x, n, &hit);
    body_velocity(&hit.pose, x, v);
    return dot(v, n);
}

/* Bodies alone: mass, flight, hinges, contacts. */
#include "../mesh_models.h"
#include "../sim/fixture.h"

#include "sim/solids/solid.h"

#include <unistd.h>

static void near(double value, double expected, double within, const char *what)
{
    if (!(fabs(value - expected) <= within))
        fail_msg("%s is %.9g, not %.9g", what, value, expected);
}

/* A box of 1 x 2 x 3 m of a mesh, turned and moved: the same mass, principal moments and centre. */
static void mesh_weighs_what_its_box_does(void **state)
{
    (void)state;
    static const double size[3] = {1, 2, 3}, at[3] = {0.3, -0.2, 0.5};
    MeshShape shape = {.triangles = model_room(6 * 4 * 4, 12 * 3 * 3)};
    const SolidDef box = {.kind = SOLID_BOX, .size = {1, 2, 3}, .density = 500};
    const SolidDef mesh = {.kind = SOLID_MESH, .mesh = {.scale = 1, .shape = &shape}, .density = 500};
    BodyMass of_box, of_mesh;
    double q[4];
    model_box(&shape.triangles, (double[3]){0}, size, 3);
    solid_turn((double[3]){1, 2, -0.5}, 40, q);
    for (size_t i = 0; i < shape.triangles.vertex_count; i++) {
        float *v = shape.triangles.vertex[i];
        double x[3] = {(double)v[0], (double)v[1], (double)v[2]};
        quat_rotate(q, x, x);
        for (int k = 0; k < 3; k++)
            v[k] = (float)(x[k] + at[k]);
    }
    body_mass(&box, 3, &of_box);
    body_mass(&mesh, 3, &of_mesh);
    near(of_box.mass, 3000, 1e-9, "the box's mass");
    near(of_mesh.mass, 3000, 1e-3, "the mesh's mass");
    for (int k = 0; k < 3; k++)
        near(of_mesh.centre[k], at[k], 1e-6, "its centre");
    for (int k = 0; k < 3; k++) {
        const double expected = 3000.0 / 12 * (14 - size[k] * size[k]);
        double axis[3] = {k == 0, k == 1, k == 2}, off = INFINITY, own[4];
        near(of_box.inertia[k], expected, 1e-9, "a moment of the box");
        quat_rotate(q, axis, axis); /* a principal axis of the mesh has this direction and moment */
        memcpy(own, of_mesh.axes, sizeof own);
        for (int p = 0; p < 3; p++) {
            double other[3] = {p == 0, p == 1, p == 2};
            quat_rotate(own, other, other);
            const double along = fabs(axis[0] * other[0] + axis[1] * other[1] + axis[2] * other[2]);
            off = fmin(off, fabs(along - 1) + fabs(of_mesh.inertia[p] / expected - 1));
        }
        near(off, 0, 1e-4, "the mesh's nearest principal axis");
    }
    triangles_free(&shape.triangles);
}

/* Body values for the energy watch, against the sum over points of the body's matter. */
static void sums_are_those_of_its_matter(void **state)
{
    (void)state;
    enum { POINTS = 40 };
    const SolidDef box = {
        .kind = SOLID_BOX, .size = {1, 2, 3}, .axis = {1, 2, -0.5}, .angle_deg = 40, .density = 500};
    Body body;
    BodyState at = {
        .pose = {.position = {0.3, -0.2, 0.5}, .velocity = {1, -2, 0.5}, .angular_velocity = {0.7, 2, -1.1}}};
    EnergySums sums = {.own = 0}, points = {.own = 0};
    body_make(&body, &box, 3);
    solid_turn((double[3]){-1, 0.3, 0.8}, 70, at.pose.orientation);
    body_sums(&body, &at, &sums);
    for (int n = 0; n < POINTS * POINTS * POINTS; n++) {
        double x[3], v[3];
        for (int k = 0; k < 3; k++) {
            const int place = k == 0 ? n % POINTS : k == 1 ? n / POINTS % POINTS : n / POINTS / POINTS;
            x[k] = box.size[k] * ((place + 0.5) / POINTS - 0.5);
        }
        quat_rotate(at.pose.orientation, x, x);
        for (int k = 0; k < 3; k++)
            x[k] += at.pose.position[k];
        body_velocity(&at.pose, x, v);
        energy_sums_add(&points, body.mass.mass / (POINTS * POINTS * POINTS), x, v);
        energy_sums_add_turning(&points, body.mass.mass / (POINTS * POINTS * POINTS), x, v);
    }
    const double *one = &sums.own, *other = &points.own;
    for (size_t k = 0; k < sizeof sums / sizeof sums.own; k++)
        near(one[k], other[k], 1e-3 * points.own, "a sum");
}

/* Textbook values of further shapes; a thick-walled bowl against the half ball without a hole. */
static void shapes_weigh_what_books_say(void **state)
{
    (void)state;
    BodyMass m;
    body_mass(&(SolidDef){.kind = SOLID_SPHERE, .radius = 2, .density = 3}, 3, &m);
    near(m.mass, 32 * M_PI, 1e-9, "a ball's mass");
    near(m.inertia[1], 0.4 * m.mass * 4, 1e-9, "its moment");
    body_mass(&(SolidDef){.kind = SOLID_SPHERE, .radius = 2, .density = 3}, 2, &m);
    near(m.inertia[2], 0.5 * 12 * M_PI * 4, 1e-9, "a disc's moment");
    body_mass(&(SolidDef){.kind = SOLID_CYLINDER, .radius = 1, .height = 3, .density = 2}, 3, &m);
    near(m.inertia[1], 0.5 * 6 * M_PI, 1e-9, "a cylinder's moment about its axis");
    near(m.inertia[0], 6 * M_PI * (3 + 9) / 12, 1e-9, "and across");
    body_mass(&(SolidDef){.kind = SOLID_BOWL, .radius = 1e-9, .thickness = 1, .density = 1}, 3, &m);
    near(m.centre[1], -0.375, 1e-6, "a half ball's centre");
    near(m.inertia[1], 0.4 * m.mass, 1e-6, "its moment about y");
    near(m.inertia[0], 83.0 / 320 * m.mass, 1e-6, "and across");
    body_mass(&(SolidDef){.kind = SOLID_BOWL, .radius = 1, .thickness = 1e-6, .density = 1}, 3, &m);
    near(m.centre[1], -0.5, 1e-5, "a thin bowl's centre");
}

/* A block tumbling about the unstable middle axis, in a turning and shaken box: energy and angular
   momentum in the world are constant; the centre flies straight. */
static void tumbling_keeps_momentum(void **state)
{
    (void)state;
    enum { STEPS = 4000 };
    static const double dt = 0.0025;
    static const Motion motions[] = {
        {.kind = MOTION_SPIN, .axis = {0, 1, 0.3}, .rate = 2},
        {.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.2, .frequency = 1}};
    Body body;
    BodyState now;
    BoxState from, to;
    double begin[3], L0[3], energy0 = 0, v_world[3];
    body_make(&body,
              &(SolidDef){.kind = SOLID_BOX, .size = {0.1, 0.2, 0.4}, .axis = {0, 1, 0}, .density = 300}, 3);
    body_start(&body, (double[3]){0}, &now);
    now.pose.angular_velocity[1] = 3, now.pose.angular_velocity[0] = 0.01, now.pose.velocity[2] = 0.5;
    box_state_at(motions, 2, 1, 0, &from);
    for (int i = 0; i <= STEPS; i++) {
        double w[3], axes[4], own[3], x[3], x_world[3], L[3], energy = 0;
        box_state_at(motions, 2, 1, dt * i, &to);
        if (i > 0)
            body_drift(&body, &from, &to, dt, &now);
        from = to;
        quat_rotate(to.orientation, now.pose.angular_velocity, w);
        for (int k = 0; k < 3; k++)
            w[k] += to.angular_velocity[k];
        quat_multiply(to.orientation, now.pose.orientation, axes);
        quat_multiply(axes, body.mass.axes, axes);
        quat_rotate_inverse(axes, w, own);
        for (int k = 0; k < 3; k++) {
            energy += 0.5 * body.mass.inertia[k] * own[k] * own[k];
            own[k] *= body.mass.inertia[k];
        }
        quat_rotate(axes, own, L);
        quat_rotate(now.pose.orientation, body.mass.centre, x);
        for (int k = 0; k < 3; k++)
            x[k] += now.pose.position[k];
        double v[3];
        body_velocity(&now.pose, x, v);
        box_to_world(&to, x, v, x_world, i == 0 ? v_world : v);
        if (i == 0) {
            memcpy(begin, x_world, sizeof begin);
            memcpy(L0, L, sizeof L0);
            energy0 = energy;
        }
        for (int k = 0; k < 3; k++) {
            near(x_world[k], begin[k] + dt * i * v_world[k], 1e-9, "the centre's way");
            near(L[k], L0[k], 1e-9, "angular momentum");
        }
        near(energy / energy0, 1, 1e-4, "energy of turning");
    }
}

/* A rod hanging from an end: the period of small swings, 2 pi sqrt(2 l / 3 g); and the same in a box
   accelerated sideways, with a slanting rod. */
static void rod_swings(void **state)
{
    (void)state;
    static const double dt = 1e-3, g = 10, length = 0.6;
    const double gravity[3] = {0, -g, 0};
    Body body;
    BodyState now;
    const BoxState still = {.orientation = {0, 0, 0, 1}};
    body_make(&body,
              &(SolidDef){.kind = SOLID_BOX,
                          .centre = {0, -0.5 * length, 0},
                          .size = {0.001, length, 0.001},
                          .axis = {0, 0, 1},
                          .density = 800,
                          .hinge_axis = {0, 0, 2}},
              3);
    for (int aslant = 0; aslant < 2; aslant++) {
        const double push = aslant ? 5 : 0, all = hypot(g, push);
        ApparentGravity apparent = {.origin = {(float)-push, (float)-g, 0}};
        double last = 0, crossings[3] = {0};
        int count = 0;
        body_start(&body, (double[3]){0}, &now);
        now.pose.angular_velocity[2] = aslant ? 0 : 0.1;
        for (int i = 1; i < 6000 && count < 3; i++) {
            body_drift(&body, &still, &still, 0.5 * dt, &now);
            body_fall(&body, gravity, &apparent, dt, &now);
            body_drift(&body, &still, &still, 0.5 * dt, &now);
            const double angle = atan2(now.pose.position[0], -now.pose.position[1]) + atan2(push, g);
            if (last * angle < 0)
                crossings[count++] = dt * (i - angle / (angle - last));
            last = angle;
            near(hypot(now.pose.position[0], now.pose.position[1]), 0.5 * length, 1e-12, "its length");
            double v[3];
            body_velocity(&now.pose, body.at, v);
            near(hypot(v[0], v[1]), 0, 1e-12, "the speed of its hinge");
        }
        /* The second one swings by 0.46: the period is longer by 1 + a^2 / 16. */
        const double wide = aslant ? 1 + pow(atan2(push, g), 2) / 16 : 1;
        near(crossings[2] - crossings[0], wide * 2 * M_PI * sqrt(2 * length / (3 * all)), 2e-3, "its period");
    }
}

/* A push moves the centre of mass and turns the body about the centre, in this step or left from the step
   before; then no push is left. */
static void pushes_move_and_turn(void **state)
{
    (void)state;
    const BodyFluid fluid = {.density = 1000, .sound = 1, .reach = 1, .gravity = 10};
    for (int left = 0; left < 2; left++) {
        const Push push = {.force = {6, 0, 0}, .torque = {0, 0, 0.5}}, none = {.force = {0}};
        Body body;
        BodyState now;
        body_make(&body,
                  &(SolidDef){.kind = SOLID_BOX, .size = {0.1, 0.2, 0.3}, .axis = {0, 1, 0}, .density = 500},
                  3);
        body_start(&body, (double[3]){0}, &now);
        now.left = left ? push : none;
        body_push(&body, &fluid, left ? &none : &push, 1e-3, &now);
        near(now.pose.velocity[0], 6 / 3.0, 1e-12, "its speed");
        near(now.pose.angular_velocity[2], 0.5 / (3.0 / 12 * 0.05), 1e-9, "its turning");
        near(now.left.force[0] + now.left.torque[2], 0, 0, "what is left");
    }
}

/* A block that falls on a corner comes to rest flat on the floor, and never inside the floor. A lying
   block stays; a ball rolls without gaining energy. */
static void blocks_come_to_rest(void **state)
{
    (void)state;
    static const double dt = 2e-3;
    const double gravity[3] = {0, -9.81, 0};
    const SolidDef solids[2] = {{.kind = SOLID_BOX,
                                 .size = {0.2, 0.1, 0.3},
                                 .centre = {0, 0.5, 0},
                                 .axis = {1, 0.3, 1},
                                 .angle_deg = 35,
                                 .density = 500},
                                {.kind = SOLID_BOX,
                                 .size = {0.2, 0.2, 0.2},
                                 .centre = {0.03, 0.9, 0.02},
                                 .axis = {0, 1, 0},
                                 .density = 500}};
    Walls walls;
    Body bodies[2];
    BodyStates now = {0};
    BoxState fixed[2];
    const BoxState still = {.orientation = {0, 0, 0, 1}};
    walls_place(&walls, 3, (double[3]){1, 2, 1}, (bool[3]){false}, 0.05);
    const BodyWorld world = {3, 2, &walls, solids, bodies, fixed, 9.81, 0.05};
    for (int b = 0; b < 2; b++) {
        body_make(&bodies[b], &solids[b], 3);
        body_start(&bodies[b], gravity, &now.of[b]);
    }
    double deepest = 0, fastest = 0;
    for (int i = 0; i < 3000; i++) {
        for (int b = 0; b < 2; b++) {
            body_drift(&bodies[b], &still, &still, 0.5 * dt, &now.of[b]);
            body_fall(&bodies[b], gravity, NULL, dt, &now.of[b]);
        }
        body_contacts_hit(&world, dt, &now);
        for (int b = 0; b < 2; b++)
            body_drift(&bodies[b], &still, &still, 0.5 * dt, &now.of[b]);
        body_contacts_part(&world, &now);
        for (int b = 0; b < 2; b++)
            for (int p = 0; p < bodies[b].hull.count; p++) {
                double x[3];
                quat_rotate(now.of[b].pose.orientation, bodies[b].hull.point[p], x);
                deepest = fmin(deepest, x[1] + now.of[b].pose.position[1]);
                const double *v = now.of[b].pose.velocity;
                fastest = i > 2500 ? fmax(fastest, fabs(v[0]) + fabs(v[1]) + fabs(v[2])) : 0;
            }
    }
    near(deepest, 0, 1e-3, "the deepest corner");
    near(fastest, 0, 0.02, "the last speed");
}

/* A body in a box of 1 x 2 x 1 m beside a pillar that does not float, for so many steps. */
static BodyStates beside_pillar(const SolidDef *body, const SolidDef *pillar, int steps)
{
    static const double dt = 2e-3;
    const double gravity[3] = {0, -9.81, 0};
    const SolidDef solids[2] = {*body, *pillar};
    const BoxState still = {.orientation = {0, 0, 0, 1}};
    Walls walls;
    Body bodies[2] = {0};
    BodyStates now = {0};
    BoxState fixed[2] = {0};
    walls_place(&walls, 3, (double[3]){1, 2, 1}, (bool[3]){false}, 0.05);
    const BodyWorld world = {3, 2, &walls, solids, bodies, fixed, 9.81, 0.05};
    body_make(&bodies[0], body, 3);
    body_start(&bodies[0], gravity, &now.of[0]);
    body_hull(pillar, 3, &bodies[1].hull);
    solid_pose(pillar, 0, &fixed[1]);
    for (int i = 0; i < steps; i++) {
        body_drift(&bodies[0], &still, &still, 0.5 * dt, &now.of[0]);
        body_fall(&bodies[0], gravity, NULL, dt, &now.of[0]);
        body_contacts_hit(&world, dt, &now);
        body_drift(&bodies[0], &still, &still, 0.5 * dt, &now.of[0]);
        body_contacts_part(&world, &now);
    }
    return now;
}

/* A plate falls with the middle of a face, without hull points, onto a fixed box and a fixed ball. */
static void what_stands_holds_a_face(void **state)
{
    (void)state;
    const SolidDef plate = {.kind = SOLID_BOX,
                            .size = {0.6, 0.04, 0.6},
                            .centre = {0, 0.5, 0},
                            .axis = {0, 1, 0},
                            .density = 500};
    const SolidDef pillars[2] = {
        {.kind = SOLID_BOX, .size = {0.08, 0.3, 0.08}, .centre = {0, 0.15, 0}, .axis = {0, 1, 0}},
        {.kind = SOLID_SPHERE, .radius = 0.1, .centre = {0, 0.2, 0}, .axis = {0, 1, 0}}};
    for (int i = 0; i < 2; i++) {
        const BodyStates now = beside_pillar(&plate, &pillars[i], 500);
        near(now.of[0].pose.position[1], 0.3 + 0.02, 2e-3, "the plate's height");
    }
}

/* All sides of a flat body are held: otherwise the body creeps and turns. */
static void what_lies_flat_stays(void **state)
{
    (void)state;
    const SolidDef far = {.kind = SOLID_SPHERE, .radius = 0.01, .centre = {0.4, 1.9, 0.4}, .axis = {0, 1, 0}};
    const SolidDef block = {.kind = SOLID_BOX,
                            .size = {0.4, 0.1, 0.4},
                            .centre = {0, 0.05, 0},
                            .axis = {0, 1, 0},
                            .density = 500};
    const BodyStates now = beside_pillar(&block, &far, 2000);
    const BoxState *pose = &now.of[0].pose;
    printf("flat: at %.3g %.3g %.3g m, turned by %.3g %.3g %.3g\n", pose->position[0],
           pose->position[1] - 0.05, pose->position[2], pose->orientation[0], pose->orientation[1],
           pose->orientation[2]);
    for (int k = 0; k < 3; k++)
        near(pose->position[k], k == 1 ? 0.05 : 0, 1e-8, "its place");
    for (int k = 0; k < 3; k++)
        near(pose->orientation[k], 0, 1e-8, "its turn");
}

/* The sentinel goes back from non-finite numbers; before the sentinel's look no loop may wait for finite
   values. */
static void what_is_no_number_ends(void **state)
{
    (void)state;
    const SolidDef ball = {.kind = SOLID_SPHERE, .radius = 0.1, .axis = {0, 1, 0}, .density = 500};
    const SolidDef solids[2] = {ball, ball};
    Walls walls;
    Body bodies[2];
    BodyStates now = {0};
    BoxState fixed[2] = {0};
    walls_place(&walls, 3, (double[3]){1, 2, 1}, (bool[3]){false}, 0.05);
    const BodyWorld world = {3, 2, &walls, solids, bodies, fixed, 9.81, 0.05};
    for (int b = 0; b < 2; b++) {
        body_make(&bodies[b], &solids[b], 3);
        body_start(&bodies[b], (double[3]){0, 1, 0}, &now.of[b]);
    }
    now.of[1].pose.orientation[0] = (double)NAN;
    alarm(60); /* end of hanging */
    body_contacts_hit(&world, 1e-3, &now);
    body_contacts_part(&world, &now);
    alarm(0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mesh_weighs_what_its_box_does),
        cmocka_unit_test(sums_are_those_of_its_matter),
        cmocka_unit_test(shapes_weigh_what_books_say),
        cmocka_unit_test(tumbling_keeps_momentum),
        cmocka_unit_test(rod_swings),
        cmocka_unit_test(pushes_move_and_turn),
        cmocka_unit_test(blocks_come_to_rest),
        cmocka_unit_test(what_is_no_number_ends),
        cmocka_unit_test(what_stands_holds_a_face),
        cmocka_unit_test(what_lies_flat_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

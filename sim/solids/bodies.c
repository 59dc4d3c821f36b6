#include "sim/solids/solid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct Bodies {
    BodiesIn in;
    Body body[SOLIDS_MAX];
    BodyStates now;
    double parted; /* greatest shift of overlaps in the last step, m */
    Forces forces; /* since the last bodies_kick or bodies_end */
    Forces *copy;  /* also receives the forces; may be NULL */
    bool owes_end; /* forces of the last step's end are under way */
    BodiesStep step;
    BoxState fixed[SOLIDS_MAX]; /* poses of fixed solids at the end of the step */
};

static bool floats(const Bodies *bodies, int solid)
{
    return solid < bodies->in.def->solid_count && solid_floats(&bodies->in.def->solids[solid]);
}

bool bodies_create(Bodies **bodies, const BodiesIn *in, Error *error)
{
    const WorldDef *def = in->def;
    bool any = false;
    BoxState box;
    double gravity[3];
    *bodies = NULL;
    for (int k = 0; k < def->solid_count; k++)
        any |= solid_floats(&def->solids[k]);
    if (!any)
        return true;
    if (!(*bodies = calloc(1, sizeof **bodies)))
        return error_set(error, "no memory for the solids that float");
    (*bodies)->in = *in;
    box_state_at(def->motions, def->motion_count, def->box_size[1], 0, &box);
    quat_rotate_inverse(box.orientation, def->gravity, gravity);
    for (int k = 0; k < def->solid_count; k++)
        if (floats(*bodies, k)) {
            body_make(&(*bodies)->body[k], &def->solids[k], def->dimensions);
            body_start(&(*bodies)->body[k], gravity, &(*bodies)->now.of[k]);
        } else {
            body_hull(&def->solids[k], def->dimensions, &(*bodies)->body[k].hull);
        }
    return true;
}

void bodies_destroy(Bodies *bodies)
{
    free(bodies);
}

Forces *bodies_forces(Bodies *bodies)
{
    return &bodies->forces;
}

void bodies_copy_forces(Bodies *bodies, Forces *to)
{
    bodies->copy = to;
}

void bodies_poses(const Bodies *bodies, BoxState floating[SOLIDS_MAX], SolidPose pose[SOLIDS_MAX])
{
    for (int k = 0; k < SOLIDS_MAX; k++)
        if (floats(bodies, k)) {
            if (floating)
                floating[k] = bodies->now.of[k].pose;
            if (pose)
                solid_pose_of(&bodies->now.of[k].pose, &pose[k]);
        }
}

/* Fills in the step of solid k, from the pose `before` to the present pose. */
static void step_from(const Bodies *bodies, int k, const BoxState *before, SolidStep *step)
{
    double change[3], alpha[3];
    solid_pose_of(before, &step->begin);
    solid_pose_of(&bodies->now.of[k].pose, &step->end);
    step->still = false;
    body_rates(&bodies->body[k], bodies->step.apparent, &bodies->now.of[k], change, alpha);
    for (int i = 0; i < 3; i++) {
        step->change[i] = (float)change[i];
        step->alpha[i] = (float)alpha[i];
    }
}

static double amount(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static BodyFluid fluid_of(const Bodies *bodies)
{
    const WorldDef *def = bodies->in.def;
    BodyFluid fluid = {.sound = bodies->in.sounds ? def->sound_speed : 0,
                       .reach = bodies->in.reach,
                       .gravity = amount(def->gravity)};
    for (int f = 0; f < def->fluid_count; f++)
        fluid.density = fmax(fluid.density, def->fluids[f].density);
    return fluid;
}

static BodyWorld surroundings(const Bodies *bodies)
{
    const WorldDef *def = bodies->in.def;
    return (BodyWorld){.dimensions = def->dimensions,
                       .count = def->solid_count,
                       .walls = bodies->in.walls,
                       .solids = def->solids,
                       .bodies = bodies->body,
                       .fixed = bodies->fixed,
                       .gravity = amount(def->gravity),
                       .spacing = def->spacing};
}

bool bodies_overlap(const Bodies *bodies, int solid, BodyOverlap *overlap)
{
    const WorldDef *def = bodies->in.def;
    BoxState fixed[SOLIDS_MAX];
    BodyWorld around = surroundings(bodies);
    around.fixed = fixed;
    for (int k = 0; k < def->solid_count; k++)
        if (!floats(bodies, k))
            solid_pose(&def->solids[k], 0, &fixed[k]);
    return floats(bodies, solid) && body_overlap(&around, &bodies->now, solid, 0.5 * def->spacing, overlap);
}

static void fly(Bodies *bodies, int half)
{
    const BodiesStep *step = &bodies->step;
    const BodyWorld around = surroundings(bodies);
    const BodyStates before = bodies->now;
    for (int k = 0; k < SOLIDS_MAX; k++)
        if (floats(bodies, k))
            body_drift(&bodies->body[k], &step->box[half], &step->box[half + 1], 0.5 * step->dt,
                       &bodies->now.of[k]);
    if (half == 1)
        bodies->parted = body_contacts_part(&around, &bodies->now);
    for (int k = 0; k < SOLIDS_MAX; k++)
        if (floats(bodies, k))
            step_from(bodies, k, &before.of[k].pose, &step->solids[half][k]);
}

static void fall(Bodies *bodies)
{
    const BodiesStep *step = &bodies->step;
    double gravity[3];
    for (int k = 0; k < 3; k++)
        gravity[k] = (double)step->gravity[k];
    for (int k = 0; k < SOLIDS_MAX; k++)
        if (floats(bodies, k))
            body_fall(&bodies->body[k], gravity, step->apparent, step->dt, &bodies->now.of[k]);
}

void bodies_begin(Bodies *bodies, const BodiesStep *step)
{
    const WorldDef *def = bodies->in.def;
    bodies->step = *step;
    for (int k = 0; k < def->solid_count; k++)
        if (!floats(bodies, k))
            solid_pose(&def->solids[k], step->time + step->dt, &bodies->fixed[k]);
    fly(bodies, 0);
    if (bodies->in.leaps) {
        fall(bodies);
        fly(bodies, 1);
    }
}

/* Takes the forces felt so far, and resets the sums. */
static void take(Bodies *bodies, Push push[SOLIDS_MAX])
{
    memcpy(push, bodies->forces.solid, sizeof bodies->forces.solid);
    if (bodies->copy)
        forces_add(bodies->copy, &bodies->forces);
    bodies->forces = (Forces){.seconds = 0};
}

void bodies_kick(Bodies *bodies)
{
    const BodyWorld around = surroundings(bodies);
    const BodyFluid fluid = fluid_of(bodies);
    Push push[SOLIDS_MAX];
    take(bodies, push);
    for (int k = 0; k < SOLIDS_MAX; k++)
        if (floats(bodies, k))
            body_push(&bodies->body[k], &fluid, &push[k], bodies->step.dt, &bodies->now.of[k]);
    if (!bodies->in.leaps)
        fall(bodies);
    body_contacts_hit(&around, bodies->step.dt, &bodies->now);
    if (!bodies->in.leaps)
        fly(bodies, 1);
}

void bodies_end(Bodies *bodies)
{
    Push push[SOLIDS_MAX];
    take(bodies, push);
    for (int k = 0; k < SOLIDS_MAX; k++)
        if (floats(bodies, k))
            push_add(&bodies->now.of[k].left, 1, &push[k]);
    bodies->owes_end = false;
}

void bodies_end_later(Bodies *bodies)
{
    bodies->owes_end = true;
}

bool bodies_owe_end(const Bodies *bodies)
{
    return bodies->owes_end;
}

double bodies_shift(const Bodies *bodies)
{
    return bodies->parted;
}

double bodies_speed(const Bodies *bodies)
{
    double most = 0;
    for (int k = 0; k < SOLIDS_MAX; k++)
        if (floats(bodies, k)) {
            const BoxState *pose = &bodies->now.of[k].pose;
            const double speed = amount(pose->velocity) +
                                 amount(pose->angular_velocity) * solid_reach(&bodies->in.def->solids[k]);
            if (!isfinite(speed + amount(pose->position)))
                return (double)NAN;
            most = fmax(most, speed);
        }
    return most;
}

void bodies_sums(const Bodies *bodies, EnergySums *sums)
{
    for (int k = 0; k < SOLIDS_MAX; k++)
        if (floats(bodies, k))
            body_sums(&bodies->body[k], &bodies->now.of[k], sums);
}

void bodies_save(const Bodies *bodies, BodyStates *to)
{
    *to = bodies->now;
}

void bodies_load(Bodies *bodies, const BodyStates *from)
{
    bodies->now = *from;
    bodies->forces = (Forces){.seconds = 0};
    bodies->owes_end = false;
}

bool bodies_are_valid(const Bodies *bodies, const BodyStates *states)
{
    for (int k = 0; k < SOLIDS_MAX; k++) {
        const double *q = states->of[k].pose.orientation;
        const double norm = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
        if (floats(bodies, k) && !(fabs(norm - 1) < 1e-6))
            return false;
    }
    return true;
}

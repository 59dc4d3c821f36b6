/* Stages of a step, each a pass over all particles. */
#include "sim/gl/fragment/fragment.h"

#include <epoxy/gl.h>
#include <string.h>

static void draw(Fragment *f, FragmentPass pass, const unsigned *targets, int count)
{
    gl_state_keep(&f->kept);
    fragment_draw(f, pass, targets, count, f->width, f->height);
    gl_state_restore(&f->kept);
}

void fragment_enter(void *state)
{
    Fragment *f = state;
    gl_state_keep(&f->kept);
}

void fragment_leave(void *state)
{
    Fragment *f = state;
    gl_state_restore(&f->kept);
}

static void set_drift(const Fragment *f, const BoxStep *step)
{
    const FragmentPass pass = FRAGMENT_DRIFT;
    const GLuint program = f->program[pass];
    glProgramUniform3fv(program, fragment_uniform(f, pass, FRAGMENT_rotation), 3, step->rotation[0]);
    fragment_set3(f, pass, FRAGMENT_omega0, step->omega0);
    fragment_set3(f, pass, FRAGMENT_omega1, step->omega1);
    fragment_set3(f, pass, FRAGMENT_shift, step->shift);
    fragment_set3(f, pass, FRAGMENT_velocity_change, step->velocity_change);
    fragment_set1(f, pass, FRAGMENT_dt, step->dt);
    glProgramUniform1i(program, fragment_uniform(f, pass, FRAGMENT_still), step->still ? 1 : 0);
}

void fragment_drift(void *state, const BoxStep *step)
{
    Fragment *f = state;
    set_drift(f, step);
    fragment_sample(FRAGMENT_SAMPLE_POSITION, f->position[0]);
    fragment_sample(FRAGMENT_SAMPLE_VELOCITY, f->velocity[0]);
    fragment_sample(FRAGMENT_SAMPLE_HELD, f->held[0]);
    draw(f, FRAGMENT_DRIFT, (const unsigned[]){f->position[1], f->velocity[1], f->held[1]}, 3);
    fragment_swap(f->position);
    fragment_swap(f->velocity);
    fragment_swap(f->held);
}

static void sample_neighbours(const Fragment *f)
{
    fragment_sample(FRAGMENT_SAMPLE_POSITION, f->position[0]);
    fragment_sample(FRAGMENT_SAMPLE_BUCKETS, f->buckets);
}

static void density(Fragment *f)
{
    sample_neighbours(f);
    fragment_sample(FRAGMENT_SAMPLE_VELOCITY, f->velocity[0]);
    draw(f, FRAGMENT_DENSITY, (const unsigned[]){f->fields, f->near, f->moving},
         f->constants->viscous ? 3 : 2);
}

static void force(Fragment *f, const ApparentGravity *gravity, float dt)
{
    fragment_set1(f, FRAGMENT_FORCE, FRAGMENT_dt, dt);
    fragment_set3(f, FRAGMENT_FORCE, FRAGMENT_felt_origin, gravity->origin);
    fragment_set3(f, FRAGMENT_FORCE, FRAGMENT_felt_alpha, gravity->alpha);
    fragment_set3(f, FRAGMENT_FORCE, FRAGMENT_felt_omega, gravity->omega);
    sample_neighbours(f);
    fragment_sample(FRAGMENT_SAMPLE_FIELDS, f->fields);
    fragment_sample(FRAGMENT_SAMPLE_VELOCITY, f->velocity[0]);
    fragment_sample(FRAGMENT_SAMPLE_NEAR, f->near);
    fragment_sample(FRAGMENT_SAMPLE_MOVING, f->moving);
    draw(f, FRAGMENT_FORCE, &f->acceleration, 1);
}

void fragment_pass(void *state, const Pass *pass, const PassInput *input)
{
    if (pass->stage == STAGE_DENSITY)
        density(state);
    else
        force(state, input->apparent, input->dt);
}

void fragment_kick(void *state, const float gravity[3], float dt)
{
    Fragment *f = state;
    fragment_set3(f, FRAGMENT_KICK, FRAGMENT_gravity, gravity);
    fragment_set1(f, FRAGMENT_KICK, FRAGMENT_dt, dt);
    fragment_sample(FRAGMENT_SAMPLE_VELOCITY, f->velocity[0]);
    fragment_sample(FRAGMENT_SAMPLE_ACCELERATION, f->acceleration);
    draw(f, FRAGMENT_KICK, &f->velocity[1], 1);
    fragment_swap(f->velocity);
    fragment_watch_gather(f, gravity, dt);
}

void fragment_touch(void *state, const FingerStep *finger)
{
    Fragment *f = state;
    const GLuint program = f->program[FRAGMENT_TOUCH];
    const float *at = finger->at, *v = finger->velocity;
    glProgramUniform4f(program, fragment_uniform(f, FRAGMENT_TOUCH, FRAGMENT_finger_at), at[0], at[1], at[2],
                       finger->inverse_radius2);
    glProgramUniform4f(program, fragment_uniform(f, FRAGMENT_TOUCH, FRAGMENT_finger_velocity), v[0], v[1],
                       v[2], finger->grip);
    fragment_set1(f, FRAGMENT_TOUCH, FRAGMENT_finger_kick, finger->kick);
    fragment_sample(FRAGMENT_SAMPLE_POSITION, f->position[0]);
    fragment_sample(FRAGMENT_SAMPLE_VELOCITY, f->velocity[0]);
    draw(f, FRAGMENT_TOUCH, &f->velocity[1], 1);
    fragment_swap(f->velocity);
}

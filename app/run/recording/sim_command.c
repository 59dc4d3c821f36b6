#include "app/run/recording/recording.h"

#include "app/scene/scene.h"
#include "sim/solids/solid.h"
#include "sim/state.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool check(const double size[3], const WorldDef *def, Error *error)
{
    for (int k = 0; k < def->dimensions; k++) {
        if (!isfinite(size[k]) || size[k] < BOX_SIDE_LEAST * def->spacing || size[k] > 1e6)
            return error_set(error, "a side of the box must be %d spacings, %.3g m, to 1e6 m, not %g m",
                             BOX_SIDE_LEAST, BOX_SIDE_LEAST * def->spacing, size[k]);
        if (def->periodic[k] && size[k] != def->box_size[k])
            return error_set(error, "the box has periodic sides along %c, and keeps its size there",
                             "xyz"[k]);
    }
    return true;
}

/* True if the fluid fits into the box; solids are not counted. */
static bool fits(const WorldDef *after, const WorldInfo *info, Error *error)
{
    double capacity = 1, fluid = (double)info->count;
    for (int k = 0; k < after->dimensions; k++) {
        capacity *= after->box_size[k];
        fluid *= after->spacing;
    }
    return fluid <= 0.97 * capacity || error_set(error, "the fluid has no room in a smaller box");
}

/* Resizes the box (m) at once, but shrinks at most by BOX_SHRINK_MOST along each axis: callers repeat for
   more. The centre of the floor stays. Rebuilds the world, which takes about as long as opening the scene:
   `world` is replaced, and `def` is its new definition. Returns false with the reason, without changes: not
   finite, too small for the particles or the method, or a periodic side. */
static bool box_command_apply(const double size[3], World **world, WorldDef *def, Error *error)
{
    WorldDef after = *def;
    WorldInfo info;
    bool smaller = false;
    if (!check(size, def, error))
        return false;
    for (int k = 0; k < def->dimensions; k++) {
        after.box_size[k] = fmax(size[k], def->box_size[k] - BOX_SHRINK_MOST * def->spacing);
        smaller |= after.box_size[k] < def->box_size[k];
    }
    world_info(*world, &info);
    if ((smaller && !fits(&after, &info, error)) || !world_set_shapes(world, &after, error))
        return false;
    *def = after;
    return true;
}

/* Of put solids, by turns: different from all fluid colours. What stays is grey. */
static const float COLORS[][3] = {{0.9F, 0.16F, 0.05F},
                                  {0.95F, 0.6F, 0.03F},
                                  {0.16F, 0.55F, 0.1F},
                                  {0.55F, 0.1F, 0.5F},
                                  {0.9F, 0.85F, 0.75F}};
static const float FIXED_COLOR[3] = {0.55F, 0.56F, 0.6F};

static const char *const acts[] = {"move", "put", "take"};

const char *solid_action_name(SolidAction act)
{
    return acts[act];
}

int solid_action_find(const char *name)
{
    for (int act = SOLID_ACTION_MOVE; act <= SOLID_ACTION_TAKE; act++)
        if (strcmp(acts[act], name) == 0)
            return act;
    return -1;
}

/* Greatest speed of a solid at which its neighbours can move out of the way: fractions of a particle's limit
   per step, and of the speed of sound. */
static double speed_of(const WorldDef *def, const WorldInfo *info)
{
    static const double OF_STEP = 0.1, OF_SOUND = 0.1;
    return fmin(OF_STEP * info->support_radius / info->dt, OF_SOUND * def->sound_speed);
}

static double clamp(double value, double low, double high)
{
    return fmax(low, fmin(value, high));
}

static void clamp_to_box(const WorldDef *def, double centre[3])
{
    for (int k = 0; k < 3; k++) {
        const double low = k == 1 ? 0 : -0.5 * def->box_size[k];
        centre[k] = clamp(centre[k], low, low + def->box_size[k]);
    }
    if (def->dimensions == 2)
        centre[2] = 0;
}

/* Keeps the solid's centre in the box. In two dimensions keeps the whole solid in, with a gap: fluid trapped
   between the solid and a wall could not flow around, and would be squeezed to nothing. */
static void keep_in_box(const WorldDef *def, const SolidDef *solid, double centre[3])
{
    static const double GAP = 2; /* spacings */
    for (int k = 0; k < 3; k++) {
        const double low = k == 1 ? 0 : -0.5 * def->box_size[k], high = low + def->box_size[k];
        const double wide = def->dimensions == 2 ? solid_reach(solid) + GAP * def->spacing : 0;
        const double off = fmin(wide, 0.5 * def->box_size[k]);
        centre[k] = clamp(centre[k], fmin(low + off, solid->centre[k]), fmax(high - off, solid->centre[k]));
    }
    if (def->dimensions == 2)
        centre[2] = 0;
}

static bool has(const WorldDef *def, int solid, Error *error)
{
    return (solid >= 0 && solid < def->solid_count) ||
           error_set(error, "there is no solid %d; the scene has %d", solid, def->solid_count);
}

static bool move(const SolidCommand *command, const WorldInfo *info, WorldDef *def, Error *error)
{
    if (!has(def, command->solid, error))
        return false;
    if (def->solids[command->solid].density > 0)
        return error_set(error, "solid %d floats: the fluid moves it", command->solid);
    SolidDef *solid = &def->solids[command->solid];
    const double speed = speed_of(def, info);
    double centre[3], at[3];
    for (int k = 0; k < 3; k++)
        centre[k] = solid->centre[k] + command->at[k];
    keep_in_box(def, solid, centre);
    for (int k = 0; k < 3; k++)
        at[k] = centre[k] - solid->centre[k];
    return solid_hand_move(&solid->hand, at, command->turn, info->time, speed, speed / solid_reach(solid),
                           def->dimensions) ||
           error_set(error, "solid %d: a place that is not finite", command->solid);
}

static bool make(const SolidCommand *command, const WorldInfo *info, const WorldDef *def, SolidDef *solid,
                 Error *error)
{
    static const double none[3] = {0}, upright[4] = {0, 0, 0, 1};
    const int like = command->like - SOLID_LIKE;
    if (like >= 0 && !has(def, like, error))
        return false;
    *solid = like >= 0 ? def->solids[like]
                       : (SolidDef){.kind = command->like == SOLID_LIKE_BALL ? SOLID_SPHERE : SOLID_BOX,
                                    .radius = command->size,
                                    .axis = {0, 1, 0}};
    const float *color =
        command->density > 0 ? COLORS[def->solid_count % (int)(sizeof COLORS / sizeof *COLORS)] : FIXED_COLOR;
    for (int k = 0; k < 3 && like < 0; k++) {
        solid->size[k] = k == 2 && def->dimensions == 2 ? def->spacing : 2 * command->size;
        solid->color[k] = color[k];
    }
    solid->motion_count = 0;
    solid->density = command->density;
    memset(solid->hinge_axis, 0, sizeof solid->hinge_axis);
    solid->hand = (SolidHand){.moved = false};
    memcpy(solid->centre, command->at, sizeof solid->centre);
    clamp_to_box(def, solid->centre);
    return (like >= 0 || command->size >= def->spacing ||
            error_set(error, "a solid must be two spacings wide")) &&
           (command->density > 0 ||
            solid_hand_move(&solid->hand, none, upright, info->time, 1, 1, def->dimensions));
}

/* True if the bounding balls of the solid and of a floating solid meet. */
static bool meets_floating(const SolidDef *solid, const SolidPose *pose, const WorldDef *def,
                           const WorldInfo *info)
{
    for (int k = 0; k < def->solid_count; k++) {
        const SolidDef *other = &def->solids[k];
        const double most = solid_reach(solid) + solid_reach(other);
        BoxState at;
        double off2 = 0;
        solid_pose_in(other, info->time, &info->floating[k], &at);
        for (int a = 0; a < 3; a++)
            off2 += (at.position[a] - (double)pose->x[a]) * (at.position[a] - (double)pose->x[a]);
        if (solid_floats(other) && off2 < most * most)
            return true;
    }
    return false;
}

/* True if the solid keeps clear of all particles and floating solids. */
static bool is_clear(const SolidDef *solid, const WorldDef *def, const WorldInfo *info, const float *position)
{
    const float half = 0.5F * (float)def->spacing;
    SolidPose pose;
    solid_pose_at(solid, info->time, &pose);
    if (meets_floating(solid, &pose, def, info))
        return false;
    for (size_t i = 0; i < info->count; i++)
        if (solid_clearance(solid, &pose, def->dimensions, position + 4 * i, half) < half)
            return false;
    return true;
}

/* Lifts the solid straight up to the first place free of fluid and floating solids. */
static bool lift(SolidDef *solid, const WorldDef *def, const WorldInfo *info, const float *position)
{
    const double *g = info->gravity, norm = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    for (;;) {
        double before[3], way = 0;
        if (is_clear(solid, def, info, position))
            return true;
        memcpy(before, solid->centre, sizeof before);
        for (int k = 0; k < 3; k++)
            solid->centre[k] += 0.5 * def->spacing * (norm > 0 ? -g[k] / norm : k == 1);
        clamp_to_box(def, solid->centre);
        for (int k = 0; k < 3; k++)
            way += fabs(solid->centre[k] - before[k]);
        if (way < 0.1 * def->spacing)
            return false;
    }
}

static bool put(const SolidCommand *command, World *world, const WorldInfo *info, WorldDef *def, Error *error)
{
    SolidDef solid;
    if (def->solid_count == SOLIDS_MAX)
        return error_set(error, "a world has up to %d solids; take one out", SOLIDS_MAX);
    if (!make(command, info, def, &solid, error))
        return false;
    float *position = malloc(4 * (info->count + 1) * sizeof *position);
    const bool read = position && world_read(world, &(ParticleArrays){.position = position});
    const bool fits = read && lift(&solid, def, info, position);
    free(position);
    if (!fits)
        return error_set(error, read ? "there is no room for a solid above that place"
                                     : "no memory to look for a place");
    def->solids[def->solid_count++] = solid;
    return true;
}

static bool take(const SolidCommand *command, WorldDef *def, Error *error)
{
    if (!has(def, command->solid, error))
        return false;
    def->solid_count--;
    memmove(def->solids + command->solid, def->solids + command->solid + 1,
            (size_t)(def->solid_count - command->solid) * sizeof *def->solids);
    memset(def->solids + def->solid_count, 0, sizeof *def->solids);
    return true;
}

/* Applies the command now: `world` may be replaced, `def` is its definition. The first move of a solid, a put
   and a take rebuild the world, which takes about as long as opening the scene. A solid reaches its place
   within about 0.15 s, no faster than the fluid tolerates; its centre stays in the box. Returns false with
   the reason, without changes: no such solid, too many, no room, no solids on the backend. */
static bool solid_command_apply(const SolidCommand *command, World **world, WorldDef *def, Error *error)
{
    WorldDef after = *def;
    WorldInfo info;
    world_info(*world, &info);
    const bool changed = command->act == SOLID_ACTION_MOVE  ? move(command, &info, &after, error)
                         : command->act == SOLID_ACTION_PUT ? put(command, *world, &info, &after, error)
                                                            : take(command, &after, error);
    if (!changed || !world_set_shapes(world, &after, error))
        return false;
    *def = after;
    return true;
}

void sim_command_setting(const SimCommand *command, char text[SETTING_TEXT_SIZE])
{
    if (command->kind == SIM_VALUE)
        setting_value_text(&command->value, text);
    else
        snprintf(text, SETTING_TEXT_SIZE, "%s", command->setting);
}

void sim_command_path(const SimCommand *command, char path[SETTING_TEXT_SIZE])
{
    if (command->kind == SIM_VALUE)
        setting_value_path(&command->value, path);
    else
        snprintf(path, SETTING_TEXT_SIZE, "%.*s", (int)strcspn(command->setting, "="), command->setting);
}

static const char BACKEND[] = "solver.backend", ACCELERATION[] = "solver.acceleration";

static bool sets(const SimCommand *command, const char *key)
{
    const size_t length = strlen(key);
    return command->kind == SIM_SET
               ? strncmp(command->setting, key, length) == 0 && command->setting[length] == '='
               : command->kind == SIM_VALUE && strcmp(command->value.key->path, key) == 0;
}

bool sim_command_poses(const SimCommand *command)
{
    return command->kind == SIM_TARGET || command->kind == SIM_CARRY;
}

bool sim_command_moves(const SimCommand *command)
{
    return sets(command, BACKEND) || sets(command, ACCELERATION);
}

bool sim_command_sets_backend(const SimCommand *command)
{
    return sets(command, BACKEND);
}

bool sim_command_changes(const SimCommand *command)
{
    return !sets(command, ACCELERATION);
}

bool sim_command_needs_gpu(const SimCommand *command)
{
    WorldDef def;
    if (command->kind != SIM_SET || !sets(command, BACKEND))
        return false;
    snprintf(def.backend, sizeof def.backend, "%.31s", command->setting + sizeof BACKEND);
    return world_on_gpu(&def);
}

static bool change_world(World **world, const WorldDef *before, const WorldDef *after, Error *error)
{
    if (strcmp(before->backend, after->backend) != 0)
        return world_move(world, after->backend, error);
    if (after->acceleration && !before->acceleration)
        return world_keep_acceleration(*world, error);
    return world_change(*world, after, error);
}

static bool apply_setting(const char *setting, World **world, Scene *scene, Error *error)
{
    Scene after = *scene;
    bool concerns_world;
    if (!scene_set_live(&after, setting, &concerns_world, error) ||
        ((concerns_world || after.world.acceleration != scene->world.acceleration) &&
         !change_world(world, &scene->world, &after.world, error)))
        return false;
    *scene = after;
    return true;
}

static bool apply_value(const SettingValue *value, World *world, Scene *scene, Error *error)
{
    SettingBefore before;
    bool concerns_world;
    if (!scene_set_value(scene, value, &before, &concerns_world, error))
        return false;
    if (!concerns_world || world_change(world, &scene->world, error))
        return true;
    scene_set_back(scene, value, &before);
    return false;
}

bool sim_command_apply(const SimCommand *command, World **world, Scene *scene, Error *error)
{
    switch (command->kind) {
    case SIM_TARGET:
        world_set_target(*world, &command->target);
        break;
    case SIM_CARRY:
        world_carry_box(*world, &command->target);
        break;
    case SIM_TOUCH:
        if (finger_fluid(&command->finger) >= 0 && !world_make_room(world, error))
            return false;
        world_set_finger(*world, &command->finger);
        break;
    case SIM_GATES:
        world_close_gates(*world, command->closed_gates);
        break;
    case SIM_SOLID:
        return solid_command_apply(&command->solid, world, &scene->world, error);
    case SIM_SIZE:
        return box_command_apply(command->size, world, &scene->world, error);
    case SIM_SET:
        return apply_setting(command->setting, world, scene, error);
    case SIM_VALUE:
        return apply_value(&command->value, *world, scene, error);
    }
    return true;
}

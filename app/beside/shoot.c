#include "app/beside/shoot.h"

#include "render/frame/overlay.h"

#include <math.h>
#include <string.h>

static const size_t KEPT_BYTES = 256U << 20; /* for steps of a run in memory */

/* Returns the index of the session or run among the sources; adds a source if it is new. */
static int source_find(Shoot *shoot, const Session *session, Recorded *recorded)
{
    int at = 0;
    while (at < shoot->source_count &&
           (shoot->sources[at].session != session || shoot->sources[at].recorded != recorded))
        at++;
    if (at == shoot->source_count) {
        shoot->source_count++;
        shoot->sources[at] = (ShootSource){.session = session,
                                           .recorded = recorded,
                                           .every = INFINITY,
                                           .watched = -INFINITY,
                                           .reel_watch = {.watched = -INFINITY}};
    }
    return at;
}

/* Adds the needs of a view to its source. */
static void source_serve(ShootSource *source, const ViewDef *view)
{
    double before;
    source->attributes |= renderer_attributes(view);
    source->every = fmin(source->every, overlays_every(view, &before));
    source->before_picture = fmax(source->before_picture, before);
}

/* Opens the reel; the scene's data stays for the panels. */
static bool reel_open(ShootSource *source, Error *error)
{
    Recorded taken = *source->recorded;
    const ReelSetup setup = {
        .recorded = &taken, .attributes = source->attributes, .bytes = KEPT_BYTES, .at_or_after = true};
    source->reel = reel_create(&setup, error);
    if (source->reel)
        source->recorded->reader = NULL;
    return source->reel != NULL;
}

/* Makes room for the world's present capacity. */
static bool uploads_fit(ShootSource *source, Error *error)
{
    WorldInfo info;
    world_info(source->session->world, &info);
    if (info.capacity <= source->room)
        return true;
    upload_destroy(source->upload_between);
    upload_destroy(source->upload);
    source->upload_between = source->upload = NULL;
    if (source->interpolates &&
        !(source->upload_between = upload_create(2 * info.capacity, source->attributes, error)))
        return false;
    if (!world_shares(source->session->world) &&
        !(source->upload = upload_create(info.capacity, upload_of_worlds(source->attributes), error)))
        return false;
    source->room = info.capacity;
    return true;
}

static bool source_open(ShootSource *source, bool interpolates, Error *error)
{
    const Session *session = source->session;
    if (!session)
        return reel_open(source, error);
    source->interpolates = interpolates && session->scene.world.step_mode == STEP_FIXED;
    return uploads_fit(source, error);
}

static void source_close(ShootSource *source)
{
    reel_destroy(source->reel);
    still_free(&source->before);
    still_free(&source->after);
    still_free(&source->between);
    upload_destroy(source->upload_between);
    upload_destroy(source->upload);
}

bool shoot_open(Shoot *shoot, const ShootPanel panels[], int count, bool interpolates, int width, int height,
                Error *error)
{
    Subject subjects[PANELS_MAX] = {{NULL}};
    *shoot = (Shoot){.panels = NULL};
    for (int i = 0; i < count; i++) {
        const ShootPanel *panel = &panels[i];
        const int known = shoot->source_count;
        shoot->source_of[i] = source_find(shoot, panel->session, panel->recorded);
        if (shoot->source_of[i] == known)
            shoot->sources[known].scene = panel->scene;
        source_serve(&shoot->sources[shoot->source_of[i]], panel->view);
        shoot->views[i] = view_in_file(panel->view);
        subjects[i] = (Subject){&shoot->views[i], panel->session ? &panel->session->scene.world
                                                                 : &panel->recorded->scene.world};
        shoot->solids[i] = subjects[i].world->solid_count;
    }
    for (int i = 0; i < shoot->source_count; i++)
        if (!source_open(&shoot->sources[i], interpolates, error))
            return false;
    shoot->panels = panels_create(subjects, count, width, height, error);
    return shoot->panels && (image_create(&shoot->image, width, height) ||
                             error_set(error, "out of memory for a picture of %d x %d", width, height));
}

void shoot_close(Shoot *shoot)
{
    image_destroy(&shoot->image);
    panels_destroy(shoot->panels);
    for (int i = 0; i < shoot->source_count; i++)
        source_close(&shoot->sources[i]);
    *shoot = (Shoot){.panels = NULL};
}

static ShootSource *source_of(Shoot *shoot, const Session *session)
{
    return &shoot->sources[source_find(shoot, session, NULL)];
}

bool shoot_interpolates(const Shoot *shoot, const Session *session)
{
    for (int i = 0; i < shoot->source_count; i++)
        if (shoot->sources[i].session == session)
            return shoot->sources[i].interpolates;
    return false;
}

bool shoot_keep(Shoot *shoot, const Session *session, Error *error)
{
    ShootSource *source = source_of(shoot, session);
    return still_read(&source->before, session->world, source->attributes) ||
           error_set(error, "out of memory for a picture between two states");
}

static bool take_between(ShootSource *source, double time, Error *error)
{
    const Session *session = source->session;
    const unsigned attributes = source->attributes;
    Still *between = &source->between;
    if (!uploads_fit(source, error))
        return false;
    if (!still_read(&source->after, session->world, attributes) ||
        !still_reserve(between, source->before.state.count + source->after.state.count, attributes) ||
        !between_states(&source->before, &source->after, session->scene.world.periodic, time, between))
        return error_set(error, "out of memory for a picture between two states");
    return upload_arrays(source->upload_between, &between->arrays, &between->state, error) &&
           upload_take(source->upload_between, &source->state);
}

static bool take_present(ShootSource *source, Error *error)
{
    World *world = source->session->world;
    if (!uploads_fit(source, error))
        return false;
    if (!world_shares(world))
        return upload_write(source->upload, world, error) && upload_take(source->upload, &source->state);
    world_share(world, source->attributes, &source->state);
    return true;
}

bool shoot_watch(Shoot *shoot, const Session *session, double time, Error *error)
{
    ShootSource *source = source_of(shoot, session);
    const double now = session->info.time;
    if (isinf(source->every) || now < time - source->before_picture ||
        now < source->watched + 0.999 * source->every)
        return true;
    if (!take_present(source, error))
        return false;
    source->watched = now;
    source->taken = false; /* not drawn */
    for (int i = 0; i < panels_count(shoot->panels); i++)
        if (&shoot->sources[shoot->source_of[i]] == source)
            panels_take(shoot->panels, i, &source->state);
    return true;
}

/* A run watched for overlays. */
typedef struct Watched {
    const Shoot *shoot;
    ShootSource *source;
} Watched;

static void see(void *user, const ParticleBuffers *particles)
{
    const Watched *watched = user;
    const Shoot *shoot = watched->shoot;
    for (int i = 0; i < panels_count(shoot->panels); i++)
        if (&shoot->sources[shoot->source_of[i]] == watched->source)
            panels_take(shoot->panels, i, particles);
    watched->source->taken = false; /* not drawn */
}

static bool watch_recorded(const Shoot *shoot, ShootSource *source, double time, Error *error)
{
    Watched watched = {shoot, source};
    ReelWatch *watch = &source->reel_watch;
    watch->every = source->every;
    watch->before = source->before_picture;
    return reel_watch(watch, source->reel, time, &(ReelSeer){see, &watched}, &source->at, error);
}

/* Takes the run's first step at or after `time`, or its last step; the next picture is expected after the
   same interval. */
static bool take_recorded(const Shoot *shoot, ShootSource *source, double time, bool *fresh, Error *error)
{
    const size_t shown = source->at.index;
    const double lead = source->taken ? fmax(time - source->watched, 0) : 0;
    if (!watch_recorded(shoot, source, time, error))
        return false;
    reel_seek(source->reel, time, lead);
    source->watched = time;
    if (!reel_wait(source->reel, &source->at, error))
        return false;
    if (source->taken && source->at.index == shown)
        return true;
    *fresh = source->taken = true;
    return reel_take(source->reel, &source->state) ||
           error_set(error, "%s: Step#%zu is not shown", source->recorded->path, source->at.index);
}

/* Takes the state of a picture at `time`. `fresh` is set if the state differs from the last picture's. */
static bool take(const Shoot *shoot, ShootSource *source, double time, bool *fresh, Error *error)
{
    const Session *session = source->session;
    if (!session)
        return take_recorded(shoot, source, source->scene ? source->scene->info.time : time, fresh, error);
    const bool between = source->interpolates && source->before.state.count > 0 &&
                         session->info.time > time + 1e-6 * session->scene.world.dt;
    if (!between && source->taken && !source->is_between && source->state.step == session->info.step)
        return true;
    if (!(between ? take_between(source, time, error) : take_present(source, error)))
        return false;
    *fresh = source->taken = true;
    source->watched = between ? source->watched : session->info.time;
    source->is_between = between;
    return true;
}

bool shoot_take(Shoot *shoot, double time, Error *error)
{
    for (int i = 0; i < shoot->source_count; i++)
        if (!take(shoot, &shoot->sources[i], time, &shoot->fresh, error))
            return false;
    return true;
}

/* Updates solids: commands of a recorded session may move, add and remove solids. */
static bool follow_solids(Shoot *shoot, int panel, Error *error)
{
    const Session *session = shoot->sources[shoot->source_of[panel]].session;
    const WorldDef *def = session ? &session->scene.world : NULL;
    bool changed = def && shoot->solids[panel] != def->solid_count;
    for (int i = 0; def && i < def->solid_count; i++)
        changed |= def->solids[i].hand.moved;
    if (changed)
        shoot->solids[panel] = def->solid_count;
    return !changed || panels_set_def(shoot->panels, panel, &shoot->views[panel], def, error);
}

bool shoot_draw(Shoot *shoot, Error *error)
{
    const ParticleBuffers *states[PANELS_MAX];
    if (!shoot->fresh)
        return true;
    shoot->fresh = false;
    for (int i = 0; i < panels_count(shoot->panels); i++) {
        states[i] = &shoot->sources[shoot->source_of[i]].state;
        if (!follow_solids(shoot, i, error))
            return false;
    }
    panels_draw(shoot->panels, states, NULL);
    lacks_take(&shoot->lacks, shoot->panels, states);
    return panels_read(shoot->panels, shoot->image.rgb, error);
}

double shoot_spread(const Shoot *shoot)
{
    double first = INFINITY, last = -INFINITY;
    for (int i = 0; i < shoot->source_count; i++) {
        if (!shoot->sources[i].session)
            continue;
        first = fmin(first, shoot->sources[i].state.time);
        last = fmax(last, shoot->sources[i].state.time);
    }
    return last - first;
}

static const uint8_t *pixel(const Image *image, int x, int y)
{
    return image->rgb + 3 * ((size_t)y * (size_t)image->width + (size_t)x);
}

bool shoot_same(const Shoot *shoot, int a, int b, const Title titles[])
{
    const PanelPlace *one = &panels_places(shoot->panels)[a], *other = &panels_places(shoot->panels)[b];
    bool same = one->width == other->width && one->height == other->height;
    const int rows_a = title_rows(&titles[a], one->height), rows_b = title_rows(&titles[b], other->height);
    for (int y = rows_a > rows_b ? rows_a : rows_b; same && y < one->height; y++)
        same = memcmp(pixel(&shoot->image, one->x, one->y + y), pixel(&shoot->image, other->x, other->y + y),
                      3 * (size_t)one->width) == 0;
    return same;
}

bool shoot_set_title(Shoot *shoot, int panel, const Title *title, Error *error)
{
    return panels_set_title(shoot->panels, panel, title, error);
}

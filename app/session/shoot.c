#include "app/session/shoot.h"

#include "render/frame/overlay.h"

#include <math.h>
#include <string.h>

/* The place of the session among the sources; a new one where it is not there yet. */
static int source_find(Shoot *shoot, const Session *session)
{
    int at = 0;
    while (at < shoot->source_count && shoot->sources[at].session != session)
        at++;
    if (at == shoot->source_count) {
        shoot->source_count++;
        shoot->sources[at] = (ShootSource){.session = session, .every = INFINITY, .watched = -INFINITY};
    }
    return at;
}

/* What a panel reads of its source. */
static void source_serve(ShootSource *source, const ViewDef *view)
{
    double before;
    source->attributes |= renderer_attributes(view);
    source->every = fmin(source->every, overlays_every(view, &before));
    source->before_picture = fmax(source->before_picture, before);
}

static bool source_open(ShootSource *source, bool interpolates, Error *error)
{
    const Session *session = source->session;
    source->interpolates = interpolates && session->scene.world.step_mode == STEP_FIXED;
    if (source->interpolates &&
        !(source->upload_between = upload_create(2 * session->info.capacity, source->attributes, error)))
        return false;
    if (world_shares(session->world))
        return true;
    source->upload = upload_create(session->info.capacity, source->attributes, error);
    return source->upload;
}

static void source_close(ShootSource *source)
{
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
        shoot->source_of[i] = source_find(shoot, panels[i].session);
        source_serve(&shoot->sources[shoot->source_of[i]], panels[i].view);
        subjects[i] = (Subject){panels[i].view, &panels[i].session->scene.world};
    }
    for (int i = 0; i < shoot->source_count; i++)
        if (!source_open(&shoot->sources[i], interpolates, error))
            return false;
    shoot->panels = panels_create(subjects, count, width, height, error);
    for (int i = 0; shoot->panels && i < count; i++)
        if (!panels_set_title(shoot->panels, i, &panels[i].title, error))
            return false;
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
    return &shoot->sources[source_find(shoot, session)];
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
    source->taken = false; /* it was not drawn */
    for (int i = 0; i < panels_count(shoot->panels); i++)
        if (&shoot->sources[shoot->source_of[i]] == source)
            panels_take(shoot->panels, i, &source->state);
    return true;
}

/* The state of a picture at that time. `fresh`: it is another one than in the picture before. */
static bool take(ShootSource *source, double time, bool *fresh, Error *error)
{
    const Session *session = source->session;
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

bool shoot_draw(Shoot *shoot, double time, Error *error)
{
    const ParticleBuffers *states[PANELS_MAX];
    bool fresh = false;
    for (int i = 0; i < shoot->source_count; i++)
        if (!take(&shoot->sources[i], time, &fresh, error))
            return false;
    if (!fresh)
        return true;
    for (int i = 0; i < panels_count(shoot->panels); i++)
        states[i] = &shoot->sources[shoot->source_of[i]].state;
    panels_draw(shoot->panels, states, NULL);
    return panels_read(shoot->panels, shoot->image.rgb, error);
}

double shoot_spread(const Shoot *shoot)
{
    double first = INFINITY, last = -INFINITY;
    for (int i = 0; i < shoot->source_count; i++) {
        first = fmin(first, shoot->sources[i].state.time);
        last = fmax(last, shoot->sources[i].state.time);
    }
    return last - first;
}

static const uint8_t *pixel(const Image *image, int x, int y)
{
    return image->rgb + 3 * ((size_t)y * (size_t)image->width + (size_t)x);
}

bool shoot_same(const Shoot *shoot, int a, int b, const Title *title)
{
    const PanelPlace *one = &panels_places(shoot->panels)[a], *other = &panels_places(shoot->panels)[b];
    bool same = one->width == other->width && one->height == other->height;
    for (int y = title_rows(title, one->height); same && y < one->height; y++)
        same = memcmp(pixel(&shoot->image, one->x, one->y + y), pixel(&shoot->image, other->x, other->y + y),
                      3 * (size_t)one->width) == 0;
    return same;
}

bool shoot_set_title(Shoot *shoot, int panel, const Title *title, Error *error)
{
    return panels_set_title(shoot->panels, panel, title, error);
}

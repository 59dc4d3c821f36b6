#include "app/run/compare/compare.h"

#include "render/frame/view.h"

#include <math.h>
#include <string.h>

void missing_attributes_add(MissingAttributes *missing, const Panels *panels,
                            const ParticleBuffers *const states[])
{
    missing->panels = panels_count(panels);
    missing->drawn++;
    for (int i = 0; i < missing->panels; i++) {
        struct PanelMissing *of = &missing->of[i];
        const char *words = renderer_missing(panels_renderer(panels, i));
        if (words && of->pictures++ == 0) {
            of->first = states[i]->time;
            snprintf(of->words, sizeof of->words, "%s", words);
        }
    }
}

void missing_attributes_print(const MissingAttributes *missing, const char *output, FILE *file)
{
    for (int i = 0; i < missing->panels; i++) {
        const struct PanelMissing *of = &missing->of[i];
        if (of->pictures == 0)
            continue;
        fprintf(file, "%s: warning: ", output);
        if (missing->panels > 1)
            fprintf(file, "panel %d: ", i + 1);
        if (missing->drawn > 1)
            fprintf(file, "%zu of %zu pictures are not as asked, the first at %.4g s: ", of->pictures,
                    missing->drawn, of->first);
        fprintf(file, "%s\n", of->words);
    }
}

static const size_t KEPT_BYTES = 256U << 20; /* for steps of a run in memory */

/* Returns the index of the session or run among the sources; adds a source if it is new. */
static int source_find(PanelPictures *pictures, const Session *session, Recorded *recorded)
{
    int at = 0;
    while (at < pictures->source_count &&
           (pictures->sources[at].session != session || pictures->sources[at].recorded != recorded))
        at++;
    if (at == pictures->source_count) {
        pictures->source_count++;
        pictures->sources[at] = (PictureSource){.session = session,
                                                .recorded = recorded,
                                                .time = -1,
                                                .every = INFINITY,
                                                .watched = -INFINITY,
                                                .prefetch_watch = {.watched = -INFINITY}};
    }
    return at;
}

/* Adds the needs of a view to its source. */
static void source_serve(PictureSource *source, const ViewDef *view)
{
    double before;
    source->attributes |= renderer_attributes(view);
    source->every = fmin(source->every, overlays_every(view, &before));
    source->before_picture = fmax(source->before_picture, before);
}

/* Opens the prefetch; the scene's data stays for the panels. */
static bool open_prefetch(PictureSource *source, Error *error)
{
    Recorded taken = *source->recorded;
    const PrefetchSetup setup = {
        .recorded = &taken, .attributes = source->attributes, .bytes = KEPT_BYTES, .at_or_after = true};
    source->prefetch = prefetch_create(&setup, error);
    if (source->prefetch)
        source->recorded->reader = NULL;
    return source->prefetch != NULL;
}

/* Makes room for the world's present capacity. */
static bool uploads_fit(PictureSource *source, Error *error)
{
    WorldInfo info;
    world_info(source->session->run.world, &info);
    if (info.capacity <= source->capacity)
        return true;
    upload_destroy(source->upload_interpolated);
    upload_destroy(source->upload);
    source->upload_interpolated = source->upload = NULL;
    if (!world_shares(source->session->run.world) &&
        !(source->upload = upload_create(info.capacity, upload_attributes(source->attributes), error)))
        return false;
    source->capacity = info.capacity;
    return true;
}

static bool source_open(PictureSource *source, Error *error)
{
    return source->session ? uploads_fit(source, error) : open_prefetch(source, error);
}

static void source_close(PictureSource *source)
{
    prefetch_destroy(source->prefetch);
    state_copy_free(&source->before);
    state_copy_free(&source->after);
    state_copy_free(&source->between);
    upload_destroy(source->upload_interpolated);
    upload_destroy(source->upload);
}

bool panel_pictures_open(PanelPictures *pictures, const PicturePanel panels[], int count, int width,
                         int height, Error *error)
{
    Subject subjects[PANELS_MAX] = {{NULL}};
    *pictures = (PanelPictures){.panels = NULL};
    for (int i = 0; i < count; i++) {
        const PicturePanel *panel = &panels[i];
        const int known = pictures->source_count;
        pictures->source_of[i] = source_find(pictures, panel->session, panel->recorded);
        if (pictures->source_of[i] == known) {
            pictures->sources[known].scene = panel->scene;
            pictures->sources[known].time = panel->view->time;
        }
        source_serve(&pictures->sources[pictures->source_of[i]], panel->view);
        pictures->asked[i] = panel->view;
        memcpy(&pictures->said[i], panel->view, sizeof pictures->said[i]);
        pictures->views[i] = view_in_file(panel->view);
        subjects[i] = (Subject){&pictures->views[i], panel->session ? &panel->session->run.scene.world
                                                                    : &panel->recorded->scene.world};
        pictures->solids[i] = subjects[i].world->solid_count;
    }
    for (int i = 0; i < pictures->source_count; i++)
        if (!source_open(&pictures->sources[i], error))
            return false;
    pictures->panels = panels_create(subjects, count, width, height, error);
    return pictures->panels && (image_create(&pictures->image, width, height) ||
                                error_set(error, "out of memory for a picture of %d x %d", width, height));
}

void panel_pictures_close(PanelPictures *pictures)
{
    image_destroy(&pictures->image);
    panels_destroy(pictures->panels);
    for (int i = 0; i < pictures->source_count; i++)
        source_close(&pictures->sources[i]);
    *pictures = (PanelPictures){.panels = NULL};
}

static const WorldDef *world_of(const PictureSource *source)
{
    return source->session ? &source->session->run.scene.world : &source->recorded->scene.world;
}

/* Takes a panel's present view. A view that reads more gets new uploads. */
static bool follow_view(PanelPictures *pictures, int panel, Error *error)
{
    PictureSource *source = &pictures->sources[pictures->source_of[panel]];
    const unsigned before = source->attributes;
    memcpy(&pictures->said[panel], pictures->asked[panel], sizeof pictures->said[panel]);
    pictures->views[panel] = view_in_file(pictures->asked[panel]);
    source_serve(source, &pictures->views[panel]);
    if (source->attributes != before && source->session) {
        source->capacity = 0;
        source->before.state.count = 0;
        source->taken = false;
        if (!uploads_fit(source, error))
            return false;
    }
    pictures->fresh = true;
    return panels_set_def(pictures->panels, panel, &pictures->views[panel], world_of(source), error);
}

/* Commands of a recorded session may change views. */
static bool follow_views(PanelPictures *pictures, Error *error)
{
    for (int i = 0; i < panels_count(pictures->panels); i++) {
        const void *asked = pictures->asked[i], *said = &pictures->said[i]; /* said: a copy, byte by byte */
        if (memcmp(asked, said, sizeof pictures->said[i]) != 0 && !follow_view(pictures, i, error))
            return false;
    }
    return true;
}

static PictureSource *source_of(PanelPictures *pictures, const Session *session)
{
    return &pictures->sources[source_find(pictures, session, NULL)];
}

bool panel_pictures_keep(PanelPictures *pictures, const Session *session, double time, Error *error)
{
    PictureSource *source = source_of(pictures, session);
    const WorldDef *def = &session->run.scene.world;
    if (!follow_views(pictures, error))
        return false;
    const double longest = def->step_mode == STEP_FIXED ? def->dt : def->max_dt;
    return session->run.info.time + 1.001 * longest < time ||
           state_copy_read(&source->before, session->run.world, source->attributes) ||
           error_set(error, "out of memory for a picture between two states");
}

static bool take_between(PictureSource *source, double time, Error *error)
{
    const Session *session = source->session;
    const unsigned attributes = source->attributes;
    StateCopy *between = &source->between;
    if (!uploads_fit(source, error) ||
        (!source->upload_interpolated &&
         !(source->upload_interpolated = upload_create(2 * source->capacity, attributes, error))))
        return false;
    if (!state_copy_read(&source->after, session->run.world, attributes) ||
        !state_copy_reserve(between, source->before.state.count + source->after.state.count, attributes) ||
        !interpolate_states(&source->before, &source->after, session->run.scene.world.periodic, time,
                            between))
        return error_set(error, "out of memory for a picture between two states");
    return upload_write_arrays(source->upload_interpolated, &between->arrays, &between->state, error) &&
           upload_take(source->upload_interpolated, &source->state);
}

static bool take_present(PictureSource *source, Error *error)
{
    World *world = source->session->run.world;
    if (!uploads_fit(source, error))
        return false;
    if (!world_shares(world))
        return upload_write(source->upload, world, error) && upload_take(source->upload, &source->state);
    world_share(world, source->attributes, &source->state);
    return true;
}

bool panel_pictures_watch(PanelPictures *pictures, const Session *session, double time, Error *error)
{
    PictureSource *source = source_of(pictures, session);
    const double now = session->run.info.time;
    if (!follow_views(pictures, error))
        return false;
    if (isinf(source->every) || now < time - source->before_picture ||
        now < source->watched + 0.999 * source->every)
        return true;
    if (!take_present(source, error))
        return false;
    source->watched = now;
    source->taken = false; /* not drawn */
    for (int i = 0; i < panels_count(pictures->panels); i++)
        if (&pictures->sources[pictures->source_of[i]] == source)
            panels_add_state(pictures->panels, i, &source->state);
    return true;
}

/* A run watched for overlays. */
typedef struct WatchedSource {
    const PanelPictures *pictures;
    PictureSource *source;
} WatchedSource;

static void see(void *user, const ParticleBuffers *particles)
{
    const WatchedSource *watched = user;
    const PanelPictures *pictures = watched->pictures;
    for (int i = 0; i < panels_count(pictures->panels); i++)
        if (&pictures->sources[pictures->source_of[i]] == watched->source)
            panels_add_state(pictures->panels, i, particles);
    watched->source->taken = false; /* not drawn */
}

static bool watch_recorded(const PanelPictures *pictures, PictureSource *source, double time, Error *error)
{
    WatchedSource watched = {pictures, source};
    PrefetchWatch *watch = &source->prefetch_watch;
    watch->every = source->every;
    watch->before = source->before_picture;
    return prefetch_watch(watch, source->prefetch, time, &(PrefetchObserver){see, &watched}, &source->at,
                          error);
}

/* Takes the run's first step at or after `time`, or its last step; the next picture is expected after the
   same interval. */
static bool take_recorded(const PanelPictures *pictures, PictureSource *source, double time, bool *fresh,
                          Error *error)
{
    const size_t shown = source->at.index;
    const double lead = source->taken ? fmax(time - source->watched, 0) : 0;
    if (!watch_recorded(pictures, source, time, error))
        return false;
    prefetch_seek(source->prefetch, time, lead);
    source->watched = time;
    if (!prefetch_wait(source->prefetch, &source->at, error))
        return false;
    if (source->taken && source->at.index == shown)
        return true;
    *fresh = source->taken = true;
    return prefetch_take(source->prefetch, &source->state) ||
           error_set(error, "%s: Step#%zu is not shown", source->recorded->path, source->at.index);
}

/* The time of a source in a picture at `time`. */
static double time_of(const PictureSource *source, double time)
{
    return source->time >= 0                   ? source->time
           : !source->session && source->scene ? source->scene->run.info.time
                                               : time;
}

/* Takes the state of a picture at `time`. `fresh` is set if the state differs from the last picture's. */
static bool take(const PanelPictures *pictures, PictureSource *source, double time, bool *fresh, Error *error)
{
    const Session *session = source->session;
    time = time_of(source, time);
    if (!session)
        return take_recorded(pictures, source, time, fresh, error);
    const bool between =
        source->before.state.count > 0 && session->run.info.time > time + 1e-6 * session->run.scene.world.dt;
    if (!between && source->taken && !source->is_interpolated && source->state.step == session->run.info.step)
        return true;
    if (!(between ? take_between(source, time, error) : take_present(source, error)))
        return false;
    *fresh = source->taken = true;
    source->watched = between ? source->watched : session->run.info.time;
    source->is_interpolated = between;
    return true;
}

bool panel_pictures_take(PanelPictures *pictures, double time, Error *error)
{
    if (!follow_views(pictures, error))
        return false;
    for (int i = 0; i < pictures->source_count; i++)
        if (!take(pictures, &pictures->sources[i], time, &pictures->fresh, error))
            return false;
    return true;
}

/* Updates solids: commands of a recorded session may move, add and remove solids. */
static bool follow_solids(PanelPictures *pictures, int panel, Error *error)
{
    const Session *session = pictures->sources[pictures->source_of[panel]].session;
    const WorldDef *def = session ? &session->run.scene.world : NULL;
    bool changed = def && pictures->solids[panel] != def->solid_count;
    for (int i = 0; def && i < def->solid_count; i++)
        changed |= def->solids[i].hand.moved;
    if (changed)
        pictures->solids[panel] = def->solid_count;
    return !changed || panels_set_def(pictures->panels, panel, &pictures->views[panel], def, error);
}

bool panel_pictures_draw(PanelPictures *pictures, Error *error)
{
    const ParticleBuffers *states[PANELS_MAX];
    if (!pictures->fresh)
        return true;
    pictures->fresh = false;
    for (int i = 0; i < panels_count(pictures->panels); i++) {
        states[i] = &pictures->sources[pictures->source_of[i]].state;
        if (!follow_solids(pictures, i, error))
            return false;
    }
    panels_draw(pictures->panels, states, NULL);
    missing_attributes_add(&pictures->missing, pictures->panels, states);
    return panels_read(pictures->panels, pictures->image.rgb, error);
}

double panel_pictures_spread(const PanelPictures *pictures)
{
    double first = INFINITY, last = -INFINITY;
    for (int i = 0; i < pictures->source_count; i++) {
        if (!pictures->sources[i].session || pictures->sources[i].time >= 0)
            continue;
        first = fmin(first, pictures->sources[i].state.time);
        last = fmax(last, pictures->sources[i].state.time);
    }
    return first < last ? last - first : 0;
}

double panel_pictures_late(const PanelPictures *pictures, double time)
{
    double late = 0;
    for (int i = 0; i < pictures->source_count; i++)
        if (pictures->sources[i].session)
            late = fmax(late, pictures->sources[i].state.time - time_of(&pictures->sources[i], time));
    return late;
}

static const uint8_t *pixel(const Image *image, int x, int y)
{
    return image->rgb + 3 * ((size_t)y * (size_t)image->width + (size_t)x);
}

bool panel_pictures_same(const PanelPictures *pictures, int a, int b, const Title titles[])
{
    const PanelRect *one = &panels_rects(pictures->panels)[a], *other = &panels_rects(pictures->panels)[b];
    bool same = one->width == other->width && one->height == other->height;
    const int rows_a = title_rows(&titles[a], one->height), rows_b = title_rows(&titles[b], other->height);
    for (int y = rows_a > rows_b ? rows_a : rows_b; same && y < one->height; y++)
        same = memcmp(pixel(&pictures->image, one->x, one->y + y),
                      pixel(&pictures->image, other->x, other->y + y), 3 * (size_t)one->width) == 0;
    return same;
}

bool panel_pictures_set_title(PanelPictures *pictures, int panel, const Title *title, Error *error)
{
    return panels_set_title(pictures->panels, panel, title, error);
}

/* Draws a picture: the fluid, the marks and the overlay; updates counters. */
#include "app/window/model.h"
#include "app/window/play_private.h"
#include "sim/world.h"

#include <string.h>

static void draw_overlay(Play *play)
{
    PlayOverlayFacts facts = {.width = play->picture.width,
                              .height = play->picture.height,
                              .renderer = window_renderer(play->window),
                              .frame_times = &play->frame_times,
                              .gl_times = play->picture.timer ? &play->picture.gl_times : NULL,
                              .about = *play->welcome.about ? play->welcome.about : NULL,
                              .calls = &play->picture.calls,
                              .movie = play->capture.video != NULL};
    const double began = thread_cpu_ms();
    panels_range(play->picture.panels, play->picture.chosen, facts.range);
    panels_curve_ranges(play->picture.panels, play->picture.chosen, facts.opacity_range, facts.size_range);
    play->picture.over |= play_overlay_draw(&play->overlay, &play->model, &facts, &play->requests);
    if (play_overlay_shown(&play->overlay, &play->model))
        frame_times_panel(&play->frame_times, thread_cpu_ms() - began);
}

/* True if the box follows the hand later than the eye expects. */
static bool box_lags(const PlayModel *model)
{
    static const double SLOW = 0.5;
    const SimulatorStatus *status = &model->status;
    const double pace = status->real_time_factor; /* 0: not known yet */
    return model->paused || (status->realtime && model->speed <= SLOW) || (pace > 0 && pace < SLOW);
}

/* Updates the pose of the box's outline: the hand's target. */
static void follow_outline(Play *play, BoxState *pose)
{
    const PlayModel *model = &play->model;
    const WorldDef *def = &model->open.scene.world;
    const ParticleBuffers *state = &model->particles;
    outline_pose(def->motions, def->motion_count, def->box_size[1], state->time, &play->wanted, pose);
    play->outlined = model->open.source->simulates && !model->status.failed &&
                     outline_is_needed(play->outlined, box_lags(model),
                                       outline_distance(&state->box, pose, def->box_size));
}

/* Draws the outline into a picture of the scene's own state. */
static void draw_outline(const PanelViewport *look, const BoxState *pose, Text *text)
{
    static const uint32_t COLOR = 0xff6ad5ff, SHADE = 0x101418a0; /* in no colormap; seen on any ground */
    static const float THICK = 0.11F;                             /* of the letters' height */
    const float em = text_height(text);
    Sight sight = look->sight;
    sight.box = *pose;
    text_begin_within(text, look->width, look->height,
                      (int[]){look->at.x, look->at.y, look->at.width, look->at.height});
    for (int i = 0; i < 2 * OUTLINE_EDGES; i++) { /* draws all shades below all lines */
        double a[3], b[3], from[2], to[2];
        const bool shade = i < OUTLINE_EDGES;
        outline_edge(look->particles->box_size, i % OUTLINE_EDGES, a, b);
        if (sight_pixel(&sight, a, from) && sight_pixel(&sight, b, to))
            text_line(text, (float)from[0], (float)from[1], (float)to[0], (float)to[1],
                      (shade ? 2 : 1) * THICK * em, shade ? SHADE : COLOR);
    }
    text_end(text);
}

static const uint32_t RESTS = 0xe8eef4e0, TOUCHES = 0xff6ad5ff;

/* Draws a ring around the held solid, or the solid under the mouse. */
static void draw_hold(const Play *play, const PanelViewport *look, const SightRay *ray,
                      const double forward[3], Text *text)
{
    const WorldDef *def = &play->model.open.scene.world;
    const SolidDrag *hold = &play->touch.hold;
    TouchDef as_wide = {.way = FINGER_STIR - 1};
    TouchTool at = {.on = true};
    BoxState pose;
    double there[3];
    const int solid =
        hold->holds ? hold->solid
                    : solid_drag_under(def, look->particles->time, look->particles->floating, ray, there);
    if (solid < 0 || solid >= def->solid_count)
        return;
    solid_pose_in(&def->solids[solid], look->particles->time, &look->particles->floating[solid], &pose);
    memcpy(at.at, pose.position, sizeof at.at);
    as_wide.radius = solid_reach(&def->solids[solid]) / def->spacing;
    const Handle ring = touch_tool_outline(&at, &as_wide, def->spacing, forward);
    handle_tool_draw_ring(look, &ring, text, hold->holds ? TOUCHES : RESTS);
}

/* Draws the finger; without a drag, at the place under the mouse. */
static void draw_finger(Play *play, const PanelViewport *look, Text *text)
{
    const Scene *scene = &play->model.open.scene;
    TouchTool tool = play->touch;
    SightRay ray;
    double forward[3];
    play_mouse_ray(play, look, &ray, forward);
    if (scene->touch.way == TOUCH_TOOL_SOLIDS) {
        draw_hold(play, look, &ray, forward, text);
        return;
    }
    if (!tool.holds) {
        const double middle[3] = {0, 0.5 * look->particles->box_size[1], 0};
        const bool shown = play->readout.found.placed;
        memcpy(tool.at, shown ? play->readout.found.place : middle, sizeof tool.at);
        if (!touch_tool_move(&tool, &ray, forward, scene->world.dimensions))
            return;
    }
    const Handle ring = touch_tool_outline(&tool, &scene->touch, scene->world.spacing, forward);
    handle_tool_draw_ring(look, &ring, text, tool.holds ? TOUCHES : RESTS);
}

/* An arrow at the panel's edge, in the direction of the box. */
static void draw_way_to_box(const PanelViewport *look, const double centre[2], Text *text)
{
    static const uint32_t COLOR = 0xffc23dff;
    const float em = text_height(text), wide = (float)look->at.width, high = (float)look->at.height;
    const float middle[2] = {0.5F * wide, 0.5F * high}, edge[2] = {middle[0] - 2 * em, middle[1] - 2 * em};
    float way[2] = {(float)centre[0] - middle[0], (float)centre[1] - middle[1]};
    const float scale = fminf(edge[0] / fmaxf(fabsf(way[0]), 1), edge[1] / fmaxf(fabsf(way[1]), 1));
    const float length = fmaxf(hypotf(way[0], way[1]), 1);
    const float tip[2] = {middle[0] + scale * way[0], middle[1] + scale * way[1]};
    for (int k = 0; k < 2; k++)
        way[k] *= 1.5F * em / length;
    const float x[] = {tip[0] + way[0], tip[0] - way[1], tip[0] + way[1]};
    const float y[] = {tip[1] + way[1], tip[1] + way[0], tip[1] - way[0]};
    text_begin_within(text, look->width, look->height,
                      (int[]){look->at.x, look->at.y, look->at.width, look->at.height});
    text_triangle(text, x, y, COLOR);
    text_end(text);
}

/* Draws handles, the outline, the finger and the readout under the mouse. */
static void draw_marks(Play *play)
{
    PlayPicture *picture = &play->picture;
    BoxState goal;
    follow_outline(play, &goal);
    for (int i = 0; i < panels_count(picture->panels); i++) {
        const PanelViewport look = play_viewport(play, i);
        if (play->outlined && look.particles == &play->model.particles &&
            !renderer_is_flat(panels_renderer(picture->panels, i)))
            draw_outline(&look, &goal, picture->text);
        handle_tool_draw(&play->handle_tool, &look, picture->text);
        double centre[2];
        const bool sees = camera_sees_box(&look, centre);
        if (!sees)
            draw_way_to_box(&look, centre, picture->text);
        if (i == picture->chosen)
            play->box_unseen = !sees;
        if (play->touch.on && !renderer_is_flat(panels_renderer(picture->panels, i)) &&
            i == picture_panel_at(picture, play->handle_tool.mouse[0], play->handle_tool.mouse[1]))
            draw_finger(play, &look, picture->text);
    }
    picture->over |= readout_draw(&play->readout, picture->panels, picture->width, picture->height,
                                  picture->text, &play->notice);
}

/* True with a GPU's renderer or backend: on a software driver calls cost nothing worth a look. */
static bool counts_calls(const Play *play)
{
    const Simulator *simulator = play->model.open.simulator;
    return play->picture.timer || (simulator && simulator_on_gpu(simulator));
}

/* `best`: the last picture once more, at best quality. */
static void draw_fluid(Play *play, bool best)
{
    PlayPicture *picture = &play->picture;
    const PlayModel *model = &play->model;
    const int count = panels_count(picture->panels);
    const double covered_left = play_overlay_covered_left(&play->overlay, picture->width);
    const ViewDef *views[PANELS_MAX];
    const ParticleBuffers *states[PANELS_MAX];
    Title titles[PANELS_MAX];
    Error error = {{0}};
    for (int i = 0; i < count; i++) {
        views[i] = views_def(&play->views, &model->open.scene, i);
        states[i] = model_state(model, views[i]);
    }
    model_titles(model, views, count, titles);
    const bool counts = !best && counts_calls(play);
    const GlCalls before = counts ? gl_calls() : (GlCalls){0};
    if (!best)
        picture_draw(picture, states, titles, covered_left);
    else if (!picture_draw_best(picture, &model->open, states, titles, covered_left, &error))
        notice_error(&play->notice, error.message);
    if (!best)
        picture->calls = counts ? gl_calls_since(&before) : (GlCalls){0};
    events_poll_hand(play);
}

/* Takes screenshots and video frames; a screenshot of a scene embeds the scene. */
static void take_files(Play *play)
{
    const PlayPicture *picture = &play->picture;
    const PlayModel *model = &play->model;
    EmbeddedScene carried = {.scene = NULL};
    Error error = {{0}};
    if (play->capture.screenshot && model->open.source->simulates && model->open.scene.view.carries_scene &&
        !scene_edits_embed(model, &carried, &error))
        notice_error(&play->notice, error.message);
    const ImageText text = embedded_scene_text(&carried, model->particles.time);
    capture_take(&play->capture, picture_panels(picture), picture->width, picture->height,
                 carried.scene ? &text : NULL, &play->notice);
    embedded_scene_free(&carried);
}

/* Presents the last drawn fluid with its overlay. */
static void present_fluid(Play *play, bool fresh)
{
    PlayPicture *picture = &play->picture;
    picture_present(picture);
    events_poll_hand(play);
    if (fresh || play->capture.screenshot)
        take_files(play);
    draw_marks(play);
    events_poll_hand(play);
    draw_overlay(play);
}

static const char *words_of(const Play *play)
{
    const char *notice = notice_now(&play->notice);
    if (notice)
        return notice;
    if (*play->scene_watch.broken.message)
        return play->scene_watch.broken.message;
    return play->model.status.failed   ? play->model.status.message
           : play->box_unseen          ? "the box is out of the picture: A shows it, B brings it home"
           : play->model.has_particles ? welcome_now(&play->welcome)
                                       : play->welcome.opening;
}

static void draw_words(const Play *play)
{
    picture_draw_words(&play->picture, words_of(play),
                       play_overlay_covered_left(&play->overlay, play->picture.width),
                       play_overlay_covered_below(&play->overlay, &play->model));
}

static void count_picture(Play *play, double began)
{
    PlayModel *model = &play->model;
    const double now = wall_ms();
    frame_times_drawn(&play->frame_times, now - began);
    if (!model->has_particles)
        return;
    model_shown(model);
    welcome_shown(&play->welcome);
    if (frame_times_begin(&play->frame_times, now))
        model->simulated_s = -model->status.simulated_s;
    if (model->paused)
        frame_times_pause(&play->frame_times, true);
    frame_times_picture(
        &play->frame_times, now,
        model->open.simulator ? simulator_applied(model->open.simulator, model->particles.step) : 0);
    frame_times_pause(&play->frame_times, model->paused);
}

bool draw_needs_fluid(const Play *play)
{
    return play->picture.dirty || play->picture.finer || picture_outdated(&play->picture) ||
           model_has_new_state(&play->model) || capture_due(&play->capture);
}

/* `best`: at rest, at best quality. */
static void draw_now(Play *play, bool best)
{
    PlayPicture *picture = &play->picture;
    const double began = wall_ms();
    const bool whole = draw_needs_fluid(play) || !play->model.paused || !play->model.has_particles ||
                       (play->capture.screenshot && !picture->best_shown);
    if (whole)
        model_take_state(&play->model);
    picture->dirty = picture->over = false;
    picture->finer = picture->finer && play->model.has_particles; /* a new scene has no state yet to refine */
    picture->begun_ms = began;
    if (play->model.has_particles && whole)
        draw_fluid(play, false);
    if (play->model.has_particles && (best || play->capture.screenshot) && picture_best_due(picture))
        draw_fluid(play, true);
    if (play->model.has_particles)
        present_fluid(play, whole);
    else
        picture_clear(picture, &play->model.open.scene.view);
    draw_words(play);
    picture_close(picture);
    do
        events_poll_hand(play);
    while (!picture_done(picture));
    window_present(play->window);
    if (whole)
        count_picture(play, began);
}

bool draw_rests(const Play *play)
{
    return play->model.paused && play->model.has_particles && play->model.status.rests &&
           !play->capture.video && !play->handle_tool.taken && !input_busy(&play->input) &&
           picture_visible(&play->picture) && picture_best_due(&play->picture);
}

static void draw(Play *play, bool best)
{
    if (!picture_visible(&play->picture))
        return;
    play->drawing = true;
    draw_now(play, best);
    play->drawing = false;
}

void draw_picture(Play *play)
{
    draw(play, false);
}

void draw_best_picture(Play *play)
{
    draw(play, true);
}

/* One picture: the fluid, what lies over it, and what is counted of it. */
#include "app/play/parts.h"
#include "sim/base/stage.h"

static void draw_overlay(Play *play)
{
    OverlayFacts facts = {.width = play->picture.width,
                          .height = play->picture.height,
                          .renderer = window_renderer(play->window),
                          .meter = &play->meter,
                          .gl_times = play->picture.timer ? &play->picture.gl_times : NULL,
                          .movie = play->files.video != NULL};
    const double began = meter_thread_cpu_ms();
    panels_range(play->picture.panels, play->picture.chosen, facts.range);
    panels_curve_ranges(play->picture.panels, play->picture.chosen, facts.opacity_range, facts.size_range);
    play->picture.over |= overlay_draw(&play->overlay, &play->model, &facts, &play->asks);
    if (overlay_shown(&play->overlay, &play->model))
        meter_panel(&play->meter, meter_thread_cpu_ms() - began);
}

/* What the mouse may take, and what is under it. */
static void draw_marks(Play *play)
{
    Picture *picture = &play->picture;
    for (int i = 0; i < panels_count(picture->panels); i++) {
        const Look look = play_look(play, i);
        grip_draw(&play->grip, &look, picture->text);
    }
    picture->over |= readout_draw(&play->readout, picture->panels, picture->width, picture->height,
                                  picture->text, &play->notice);
}

static void draw_fluid(Play *play)
{
    Picture *picture = &play->picture;
    const Model *model = &play->model;
    const int count = panels_count(picture->panels);
    const ViewDef *views[PANELS_MAX];
    const ParticleBuffers *states[PANELS_MAX];
    Title titles[PANELS_MAX];
    for (int i = 0; i < count; i++) {
        views[i] = views_def(&play->views, &model->open.scene, i);
        states[i] = model_state(model, views[i]);
    }
    model_titles(model, views, count, titles);
    picture_draw(picture, states, titles, overlay_covered_left(&play->overlay, picture->width));
    events_follow_hand(play);
}

/* The fluid as it was drawn last, and what lies over it. */
static void present_fluid(Play *play, bool fresh)
{
    Picture *picture = &play->picture;
    picture_present(picture);
    if (fresh)
        files_take(&play->files, picture->panels, picture->width, picture->height, &play->notice);
    draw_marks(play);
    draw_overlay(play);
}

static const char *words_of(const Play *play)
{
    const char *notice = notice_now(&play->notice);
    if (notice)
        return notice;
    return play->model.status.failed   ? play->model.status.message
           : play->model.has_particles ? NULL
                                       : "filling the box ...";
}

static void count_picture(Play *play, double began)
{
    Model *model = &play->model;
    const double now = wall_ms();
    meter_drawn(&play->meter, now - began);
    if (!model->has_particles)
        return;
    if (meter_begin(&play->meter, now))
        model->simulated_s = -model->status.simulated_s;
    if (model->paused)
        meter_rest(&play->meter, true);
    meter_picture(&play->meter, now,
                  model->open.simulator ? simulator_obeyed(model->open.simulator, model->particles.step) : 0);
    meter_rest(&play->meter, model->paused);
}

bool draw_needs_fluid(const Play *play)
{
    return play->picture.dirty || picture_unsettled(&play->picture) || model_fresh(&play->model) ||
           files_due(&play->files);
}

void draw_picture(Play *play)
{
    Picture *picture = &play->picture;
    const double began = wall_ms();
    const bool whole =
        draw_needs_fluid(play) || !play->model.paused || !play->model.has_particles || play->files.shoot;
    if (!picture_visible(picture))
        return;
    if (whole)
        model_take(&play->model);
    picture->dirty = picture->over = false;
    picture->begun_ms = began;
    if (play->model.has_particles && whole)
        draw_fluid(play);
    if (play->model.has_particles)
        present_fluid(play, whole);
    else
        picture_clear(picture, &play->model.open.scene.view);
    picture_words(picture, words_of(play), overlay_covered_below(&play->overlay, &play->model));
    picture_close(picture);
    do
        events_follow_hand(play);
    while (!picture_done(picture));
    window_present(play->window);
    if (whole)
        count_picture(play, began);
}

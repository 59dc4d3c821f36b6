#include "app/base/file.h"
#include "app/files/pictures.h"
#include "app/window/play_private.h"
#include "sim/gpu/gl.h"
#include "sim/world.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double LETTERS = 14; /* pixels of height at scale 1 */
static const double SHADERS_MS = 300;
static const double SETTLE_MS = 100; /* age of a picture before late numbers are corrected */

float picture_letters(const Window *window)
{
    return (float)(LETTERS * window_scale(window));
}

bool picture_read_display(PlayPicture *picture, const Window *window, Error *error)
{
    picture->refresh = window_refresh(window);
    window_size(window, &picture->width, &picture->height);
    if (gl_renderer_is_software())
        picture->pauses = gl_timer_create(GL_CLOCK_OFF);
    else
        picture->timer = gl_timer_create(GL_CLOCK_QUERY);
    picture->text = text_create(picture_letters(window), error);
    return picture->text != NULL;
}

/* The view of a panel: the scene's `view` is the chosen one. */
static const ViewDef *shown(const Scene *scene, int chosen, int panel)
{
    return panel == chosen ? &scene->view : scene_view(scene, panel);
}

static const WorldDef *world_of(const PlayScene *open, const ViewDef *view)
{
    const WorldDef *beside = compare_world(open->compared, view);
    return beside ? beside : &open->scene.world;
}

/* The subjects of all panels; `best`: at the quality of files. `views` has room for the defs. Returns the
   count. */
static int subjects_of(const PlayPicture *picture, const PlayScene *open, bool best, ViewDef views[],
                       Subject subjects[])
{
    const int count = scene_view_count(&open->scene);
    for (int i = 0; i < count; i++) {
        const ViewDef *view = shown(&open->scene, count > 1 ? picture->chosen : 0, i);
        views[i] = best ? view_in_file(view) : *view;
        subjects[i] = (Subject){&views[i], world_of(open, view)};
    }
    return count;
}

/* Creates new panels; on failure the old panels stay. */
static bool replace_panels(PlayPicture *picture, const PlayScene *open, int width, int height, Error *error)
{
    ViewDef views[PANELS_MAX];
    Subject subjects[PANELS_MAX] = {{NULL}};
    const int count = subjects_of(picture, open, false, views, subjects);
    Panels *panels = panels_create(subjects, count, width, height, error);
    if (!panels)
        return false;
    panels_destroy(picture->panels);
    picture->panels = panels;
    panels_set_late(panels, !gl_renderer_is_software()); /* whose requests are already finished */
    panels_set_continuous(panels, true);
    panels_set_presents(panels, true);
    picture->chosen = picture->chosen < count ? picture->chosen : 0;
    panels_set_marked(panels, picture->chosen);
    return true;
}

/* Brings the best panels up to date. */
static bool follow_best(PlayPicture *picture, const PlayScene *open, Error *error)
{
    ViewDef views[PANELS_MAX];
    Subject subjects[PANELS_MAX] = {{NULL}};
    const int count = subjects_of(picture, open, true, views, subjects);
    if (picture->best && panels_count(picture->best) != count) {
        panels_destroy(picture->best);
        picture->best = NULL;
    }
    if (!picture->best)
        return (picture->best = panels_create(subjects, count, picture->width, picture->height, error));
    bool set = panels_resize(picture->best, picture->width, picture->height, error);
    for (int i = 0; i < count && set; i++)
        set = panels_set_def(picture->best, i, subjects[i].def, subjects[i].world, error);
    return set;
}

bool picture_start(PlayPicture *picture, const PlayScene *open, Error *error)
{
    const int width = (int)fmax(picture->width, 1), height = (int)fmax(picture->height, 1);
    if (!replace_panels(picture, open, width, height, error))
        return false;
    picture->shaders_stamp = shader_source_stamp();
    return true;
}

void picture_end(PlayPicture *picture)
{
    text_destroy(picture->text);
    gl_timer_destroy(picture->timer);
    gl_timer_destroy(picture->pauses);
    panels_destroy(picture->panels);
    panels_destroy(picture->best);
}

/* Sets the views of all panels. */
static bool set_views(PlayPicture *picture, const PlayScene *open, int chosen, Error *error)
{
    bool set = true;
    for (int i = 0; i < panels_count(picture->panels); i++) {
        const ViewDef *view = shown(&open->scene, chosen, i);
        set &= panels_set_def(picture->panels, i, view, world_of(open, view), error);
    }
    return set;
}

void picture_set_view(PlayPicture *picture, const PlayScene *open, int chosen, Notice *notice)
{
    Error error = {{0}};
    const int width = (int)fmax(picture->width, 1), height = (int)fmax(picture->height, 1);
    picture->dirty = true;
    picture->best_fails = false;
    picture->chosen = chosen;
    if (!(panels_count(picture->panels) != scene_view_count(&open->scene)
              ? replace_panels(picture, open, width, height, &error)
              : set_views(picture, open, chosen, &error)))
        notice_error(notice, error.message);
    const int there = panels_count(picture->panels);
    picture->chosen = chosen < there ? chosen : 0;
    panels_set_marked(picture->panels, picture->chosen);
}

PanelRect picture_place(const PlayPicture *picture, int panel, double covered_left)
{
    PanelRect places[PANELS_MAX];
    const int count = picture->panels ? panels_count(picture->panels) : 1;
    const int beside = count > 1 ? (int)lround(covered_left * picture->width) : 0;
    if (!panels_layout(count, picture->width - beside, picture->height, places))
        return (PanelRect){0, 0, (int)fmax(picture->width, 1), (int)fmax(picture->height, 1)};
    places[panel].x += beside;
    return places[panel];
}

int picture_panel_at(const PlayPicture *picture, double x, double y)
{
    return picture->panels
               ? panels_index_at(panels_rects(picture->panels), panels_count(picture->panels), x, y)
               : 0;
}

bool picture_follow_size(PlayPicture *picture, const Window *window, Error *error)
{
    int width, height;
    window_size(window, &width, &height);
    if (width == picture->width && height == picture->height)
        return true;
    PanelRect places[PANELS_MAX];
    picture->width = width;
    picture->height = height;
    picture->dirty = true;
    if (width > 0 && height > 0 && !panels_layout(panels_count(picture->panels), width, height, places))
        picture->width = 0; /* as if minimised: the window is too small for several views */
    return picture->width < 1 || height < 1 || panels_resize(picture->panels, width, height, error);
}

bool picture_follow_scale(PlayPicture *picture, float letters)
{
    Error error = {{0}};
    if (letters == text_height(picture->text))
        return false;
    Text *text = text_create(letters, &error);
    if (!text)
        return false;
    text_destroy(picture->text);
    picture->text = text;
    picture->dirty = true;
    return true;
}

bool picture_visible(const PlayPicture *picture)
{
    return picture->width > 0 && picture->height > 0;
}

bool picture_outdated(const PlayPicture *picture)
{
    return picture->panels && panels_are_stale(picture->panels) && wall_ms() >= picture->begun_ms + SETTLE_MS;
}

bool picture_at_rest(const PlayPicture *picture)
{
    return !picture->dirty && !picture->over && !(picture->panels && panels_are_stale(picture->panels));
}

bool picture_shaders_changed(PlayPicture *picture)
{
    if (wall_ms() < picture->shaders_due_ms)
        return false;
    picture->shaders_due_ms = wall_ms() + SHADERS_MS;
    const uint64_t stamp = shader_source_stamp();
    if (stamp == picture->shaders_stamp || !picture_visible(picture))
        return false;
    picture->shaders_stamp = stamp;
    return true;
}

bool picture_reload(PlayPicture *picture, const PlayScene *open, Error *error)
{
    return replace_panels(picture, open, picture->width, picture->height, error);
}

static void prepare(Panels *panels, const Title titles[], double covered_left)
{
    Error error;
    for (int i = 0; i < panels_count(panels); i++)
        panels_set_title(panels, i, &titles[i], &error); /* without a font the old title stays */
    panels_set_covered(panels, covered_left, &error);    /* without room the old layout stays */
}

void picture_draw(PlayPicture *picture, const ParticleBuffers *const states[], const Title titles[],
                  double covered_left)
{
    prepare(picture->panels, titles, covered_left);
    panels_draw(picture->panels, states, picture->timer ? picture->timer : picture->pauses);
    picture->finer = panels_unfinished(picture->panels);
    picture->best_shown = false;
    picture->drawn_ms = wall_ms();
    gl_timer_frame(picture->timer, &picture->gl_times);
}

bool picture_draw_best(PlayPicture *picture, const PlayScene *open, const ParticleBuffers *const states[],
                       const Title titles[], double covered_left, Error *error)
{
    picture->best_fails = !follow_best(picture, open, error);
    if (picture->best_fails)
        return false;
    panels_set_marked(picture->best, picture->chosen);
    prepare(picture->best, titles, covered_left);
    panels_draw(picture->best, states, picture->pauses);
    picture->best_shown = true;
    return true;
}

bool picture_best_due(const PlayPicture *picture)
{
    return picture->panels && !picture->best_shown && !picture->best_fails && !picture->finer &&
           panels_can_improve(picture->panels);
}

const Panels *picture_panels(const PlayPicture *picture)
{
    return picture->best_shown ? picture->best : picture->panels;
}

void picture_present(PlayPicture *picture)
{
    panels_present(picture_panels(picture));
}

void picture_clear(const PlayPicture *picture, const ViewDef *view)
{
    const double *back = view->background;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, picture->width, picture->height);
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glClearColor((float)back[0], (float)back[1], (float)back[2], 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

enum { WORD_LINES = 6, WORD_LINE = 400 };

/* Breaks text at line ends, and where wider than `most` pixels at blanks; the last line gets the rest.
 * Returns the count of lines. */
static int break_lines(Text *text, const char *words, float most, char lines[WORD_LINES][WORD_LINE])
{
    int count = 0;
    while (*words && count < WORD_LINES) {
        char *line = lines[count++], *blank;
        snprintf(line, WORD_LINE, "%.*s", (int)strcspn(words, "\n"), words);
        while (count < WORD_LINES && text_width(text, 1, line) > most && (blank = strrchr(line, ' ')))
            *blank = 0;
        words += strlen(line);
        words += strspn(words, " \n");
    }
    return count;
}

void picture_draw_words(const PlayPicture *picture, const char *words, double covered_left, float below)
{
    Text *text = picture->text;
    char lines[WORD_LINES][WORD_LINE];
    if (!words)
        return;
    const float em = text_height(text), high = 1.4F * em, wide = (float)picture->width;
    const float left = (float)covered_left * wide, middle = 0.5F * (left + wide);
    const int count = break_lines(text, words, wide - left - 3 * em, lines);
    const float top = (float)picture->height - below - 4 * em - high * (float)(count - 1);
    float width = 0;
    for (int i = 0; i < count; i++)
        width = fmaxf(width, text_width(text, 1, lines[i]));
    text_begin(text, picture->width, picture->height);
    text_rectangle(text, middle - 0.5F * width - em, top - 0.5F * em, middle + 0.5F * width + em,
                   top + 1.5F * em + high * (float)(count - 1), 0.4F * em, 0x10141ac0);
    for (int i = 0; i < count; i++)
        text_draw(text, middle, top + high * (float)i, 1, 0xf2f4f6ff, TEXT_CENTER, lines[i]);
    text_end(text);
}

void picture_say(PlayPicture *picture, const ViewDef *view, const char *words, Window *window)
{
    if (!picture->text || !picture_visible(picture))
        return;
    if (picture->panels)
        picture_present(picture);
    else
        picture_clear(picture, view);
    picture_draw_words(picture, words, 0, 0);
    window_present(window);
}

void picture_close(PlayPicture *picture)
{
    picture->asked = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

bool picture_done(PlayPicture *picture)
{
    static const GLuint64 pause_ns = 2000000;
    GLsync asked = picture->asked;
    if (asked && glClientWaitSync(asked, GL_SYNC_FLUSH_COMMANDS_BIT, pause_ns) == GL_TIMEOUT_EXPIRED)
        return false;
    glDeleteSync(asked);
    picture->asked = NULL;
    return true;
}

static const double MOVIE_FPS = 30;

static bool read_picture(const Panels *panels, int width, int height, Image *image, Error *error)
{
    if (!image_create(image, width, height))
        return error_set(error, "no memory for a picture");
    return panels_read(panels, image->rgb, error);
}

static void take_screenshot(Capture *capture, const Panels *panels, int width, int height,
                            const ImageText *text, Notice *notice)
{
    Image image = {0};
    Output output = {.temp = ""};
    Error error = {{0}};
    char path[1024];
    dated_file_name(path, "png");
    capture->screenshot = false;
    if (read_picture(panels, width, height, &image, &error) && output_begin(&output, path, &error) &&
        image_write(&image, text, output.temp, &error) && output_commit(&output, &error))
        notice_tell(notice, text ? "%s: the picture; slosh %s opens its scene again" : "%s: the picture",
                    path, path);
    else
        notice_error(notice, error.message);
    output_discard(&output);
    image_destroy(&image);
}

bool capture_end(Capture *capture, Notice *notice)
{
    Error error = {{0}};
    Video *video = capture->video;
    if (!video)
        return true;
    capture->video = NULL;
    if (!video_finish(video, &error)) {
        notice_error(notice, error.message);
        return false;
    }
    notice_tell(notice, "%s: the video, %.1f s", capture->path, (double)capture->pictures / MOVIE_FPS);
    return true;
}

bool capture_due(const Capture *capture)
{
    return capture->video && wall_ms() >= capture->next_ms;
}

void capture_toggle_video(Capture *capture, int width, int height, Notice *notice)
{
    Error error = {{0}};
    if (capture->video) {
        capture_end(capture, notice);
        return;
    }
    *capture = (Capture){.screenshot = capture->screenshot, .width = width, .height = height};
    dated_file_name(capture->path, "mp4");
    capture->video = video_create(capture->path, width, height, MOVIE_FPS, &error);
    if (capture->video)
        notice_tell(notice, "%s: recording until you ask again", capture->path);
    else
        notice_error(notice, error.message);
}

/* Adds the picture as often as frames are due: a video runs at its own, even rate. Frames lost in a stall of
   over a second stay lost. */
static bool add_due(Capture *capture, const Image *image, Error *error)
{
    const double now = wall_ms();
    if (capture->pictures == 0 || capture->next_ms < now - 1000)
        capture->next_ms = now;
    while (capture->next_ms <= now) {
        if (!video_add(capture->video, image->rgb, error))
            return false;
        capture->next_ms += 1000 / MOVIE_FPS;
        capture->pictures++;
    }
    return true;
}

static void take_frame(Capture *capture, const Panels *panels, int width, int height, Notice *notice)
{
    Image image = {0};
    Error error = {{0}};
    if (width != capture->width || height != capture->height) {
        capture_end(capture, notice);
        return;
    }
    if (!read_picture(panels, width, height, &image, &error) || !add_due(capture, &image, &error)) {
        video_discard(capture->video);
        capture->video = NULL;
        notice_error(notice, error.message);
    }
    image_destroy(&image);
}

void capture_take(Capture *capture, const Panels *panels, int width, int height, const ImageText *text,
                  Notice *notice)
{
    if (capture_due(capture))
        take_frame(capture, panels, width, height, notice);
    if (capture->screenshot)
        take_screenshot(capture, panels, width, height, text, notice);
}

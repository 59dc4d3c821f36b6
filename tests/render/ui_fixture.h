/* A Ui on a framebuffer, driven by input as a window would: frames of a sixtieth of a second. */
#ifndef SLOSH_UI_FIXTURE_H
#define SLOSH_UI_FIXTURE_H

#include "tests/render/fixture.h"

#include "render/frame/frame.h"
#include "render/ui/ui.h"

#include <epoxy/gl.h>

enum { SEEN_MAX = 512, SEEN_ID_SIZE = 160 };

/* A text or widget of the last frame that was built. */
typedef struct Seen {
    char id[SEEN_ID_SIZE];
    float rect[4], needed;
} Seen;

typedef struct Desk {
    Target target;
    Ui *ui;
    UiInput input;
    int seen_count, built; /* frames in all that were no repetition */
    Seen seen[SEEN_MAX];
    void (*draw)(void *user, struct Desk *desk); /* the widgets */
    void *user;
} Desk;

static inline void desk_see(void *user, const char *id, const float rect[4], float needed)
{
    Desk *desk = user;
    assert_true(desk->seen_count < SEEN_MAX);
    Seen *seen = &desk->seen[desk->seen_count++];
    snprintf(seen->id, sizeof seen->id, "%s", id);
    memcpy(seen->rect, rect, sizeof seen->rect);
    seen->needed = needed;
}

static inline const Seen *desk_find(const Desk *desk, const char *id)
{
    for (int i = 0; i < desk->seen_count; i++)
        if (strcmp(desk->seen[i].id, id) == 0)
            return &desk->seen[i];
    return NULL;
}

static inline bool desk_frame(Desk *desk)
{
    glBindFramebuffer(GL_FRAMEBUFFER, desk->target.framebuffer);
    const bool build = ui_begin(desk->ui, desk->target.width, desk->target.height, &desk->input);
    if (build) {
        desk->seen_count = 0;
        desk->built++;
        desk->draw(desk->user, desk);
    }
    ui_end(desk->ui);
    desk->input.wheel = 0;
    desk->input.text[0] = 0;
    return build;
}

static inline void desk_frames(Desk *desk, int count)
{
    for (int i = 0; i < count; i++)
        desk_frame(desk);
}

static inline void desk_move(Desk *desk, float x, float y)
{
    desk->input.mouse[0] = x;
    desk->input.mouse[1] = y;
    desk_frames(desk, 2);
}

static inline void desk_press(Desk *desk, bool down)
{
    desk->input.button[0] = down;
    desk_frames(desk, 2);
}

static inline void desk_click(Desk *desk, float x, float y)
{
    desk_move(desk, x, y);
    desk_press(desk, true);
    desk_press(desk, false);
    desk_frames(desk, 2);
}

/* At a share of the width of a widget, in the middle of its height. */
static inline void desk_click_at(Desk *desk, const char *id, float share)
{
    const Seen *seen = desk_find(desk, id);
    if (!seen) {
        fail_msg("no widget %s", id);
        return;
    }
    const float x = seen->rect[0] + share * (seen->rect[2] - seen->rect[0]);
    desk_click(desk, x, (seen->rect[1] + seen->rect[3]) / 2);
}

static inline void desk_key(Desk *desk, unsigned keys)
{
    desk->input.keys = keys;
    desk_frames(desk, 2);
    desk->input.keys = 0;
    desk_frames(desk, 2);
}

static inline void desk_type(Desk *desk, const char *text)
{
    snprintf(desk->input.text, sizeof desk->input.text, "%s", text);
    desk_frames(desk, 2);
}

static inline void desk_clear(Desk *desk)
{
    glBindFramebuffer(GL_FRAMEBUFFER, desk->target.framebuffer);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glClearColor(1, 0, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_FRAMEBUFFER_SRGB);
}

static inline void desk_open(Desk *desk, int width, int height, float pixels)
{
    Error error = {{0}};
    *desk = (Desk){.input = {.mouse = {-1, -1}, .dt = 1.0 / 60}};
    assert_true(target_create(&desk->target, width, height, &error));
    desk->ui = ui_create(pixels, &error);
    assert_non_null(desk->ui);
    ui_watch(desk->ui, desk_see, desk);
    desk_clear(desk);
}

static inline void desk_close(Desk *desk)
{
    ui_destroy(desk->ui);
    target_destroy(&desk->target);
}

/* 3 * width * height bytes, rows from the top down; the caller frees it. */
static inline uint8_t *desk_read(const Desk *desk)
{
    uint8_t *rgb = malloc(3 * (size_t)desk->target.width * (size_t)desk->target.height);
    assert_non_null(rgb);
    target_read(&desk->target, rgb);
    return rgb;
}

static inline bool is_cleared(const uint8_t *pixel)
{
    return pixel[0] == 255 && pixel[1] == 0 && pixel[2] == 255;
}

#endif

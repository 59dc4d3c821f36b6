/* One picture: the fluid, what is said over it, and the screen. */
#include "app/play/play_state.h"
#include "sim/base/stage.h"

#include <epoxy/gl.h>
#include <time.h>

/* Before the first state: the scene's background, and what is being made. */
static void draw_waiting(Play *play)
{
    const double *back = play->open.scene.view.background;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, play->width, play->height);
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glClearColor((float)back[0], (float)back[1], (float)back[2], 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

static void draw_notice(Play *play, const char *notice)
{
    const float em = text_height(play->text), width = text_width(play->text, 1, notice);
    const float middle = 0.5F * (float)play->width, top = (float)play->height - 4 * em;
    text_begin(play->text, play->width, play->height);
    text_rectangle(play->text, middle - 0.5F * width - em, top - 0.5F * em, middle + 0.5F * width + em,
                   top + 1.5F * em, 0.4F * em, 0x10141ac0);
    text_draw(play->text, middle, top, 1, 0xf2f4f6ff, TEXT_CENTER, notice);
    text_end(play->text);
}

static void draw_words(Play *play)
{
    if (wall_ms() < play->notice_until_ms)
        draw_notice(play, play->notice);
    else if (play->status.failed)
        draw_notice(play, play->status.message);
    else if (!play->has_particles)
        draw_notice(play, "filling the box ...");
}

/* What the user does while the GPU draws is obeyed a picture sooner. */
static void look_while_drawing(Play *play)
{
    static const GLuint64 pause_ns = 2000000;
    GLsync drawn = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    do
        play_events(play);
    while (drawn && glClientWaitSync(drawn, GL_SYNC_FLUSH_COMMANDS_BIT, pause_ns) == GL_TIMEOUT_EXPIRED);
    glDeleteSync(drawn);
}

static void begin_counting(Play *play)
{
    struct timespec cpu;
    play->began_ms = wall_ms();
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
    play->began_cpu_ms = 1e3 * (double)cpu.tv_sec + 1e-6 * (double)cpu.tv_nsec;
    play->simulated_s = -play->status.simulated_s;
}

void play_draw(Play *play)
{
    const double began = wall_ms();
    if (play->width < 1 || play->height < 1)
        return;
    play->has_particles = play_scene_take(&play->open, &play->particles);
    play->dirty = false;
    play->drew_ms = began;
    if (play->has_particles) {
        renderer_set_covered(play->renderer, play_covered_left(play));
        renderer_draw(play->renderer, &play->particles, play->timer);
        gl_timer_frame(play->timer, &play->gl_times);
        play_events(play);
        renderer_present(play->renderer);
        play_movie_picture(play);
        if (play->shoot)
            play_screenshot(play);
    } else {
        draw_waiting(play);
    }
    if (play->has_particles)
        play_panel_draw(play);
    draw_words(play);
    look_while_drawing(play);
    window_present(play->window);
    const double now = wall_ms();
    play->last_render_ms = now - began;
    play->render_ms += now - began;
    play->rendered++;
    if (!play->has_particles)
        return;
    if (play->began_ms == 0)
        begin_counting(play);
    meter_picture(&play->meter, now, simulator_obeyed(play->open.simulator, play->particles.step));
}

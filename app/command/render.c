#include "app/base/interrupt.h"
#include "app/base/json_file.h"
#include "app/base/progress.h"
#include "app/command/cmd.h"
#include "app/output/pictures.h"
#include "app/session/between.h"
#include "app/session/session.h"
#include "app/session/studio.h"
#include "sim/gl/debug.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>

/* A studio and the last picture. */
typedef struct Shoot {
    Studio studio;
    bool interpolates;
    Upload *upload;               /* of what is between two states; NULL: none is asked for */
    Still before, after, between; /* the state before the last step, and so on */
    Image image;
    uint64_t drawn_step; /* of the state in `image` */
    bool drawn;
} Shoot;

static bool shoot_open(Shoot *shoot, const Session *session, const Args *args, Error *error)
{
    if (!studio_open(&shoot->studio, &session->scene.view, &session->scene.world, session->world, args->width,
                     args->height, error))
        return false;
    shoot->interpolates = args->interpolate && session->scene.world.step_mode == STEP_FIXED;
    if (shoot->interpolates &&
        !(shoot->upload = upload_create(2 * session->info.capacity, shoot->studio.attributes, error)))
        return false;
    return image_create(&shoot->image, args->width, args->height) ||
           error_set(error, "out of memory for a picture of %d x %d", args->width, args->height);
}

static void shoot_close(Shoot *shoot)
{
    image_destroy(&shoot->image);
    still_free(&shoot->before);
    still_free(&shoot->after);
    still_free(&shoot->between);
    upload_destroy(shoot->upload);
    studio_close(&shoot->studio);
}

static bool draw_between(Shoot *shoot, Session *session, double time, Error *error)
{
    const unsigned attributes = shoot->studio.attributes;
    ParticleBuffers particles;
    if (!still_read(&shoot->after, session->world, attributes) ||
        !still_reserve(&shoot->between, shoot->before.state.count + shoot->after.state.count, attributes) ||
        !between_states(&shoot->before, &shoot->after, session->scene.world.periodic, time, &shoot->between))
        return error_set(error, "out of memory for a picture between two states");
    if (!upload_arrays(shoot->upload, &shoot->between.arrays, &shoot->between.state, error) ||
        !upload_take(shoot->upload, &particles))
        return false;
    renderer_draw(shoot->studio.renderer, &particles, NULL);
    renderer_read(shoot->studio.renderer, shoot->image.rgb);
    shoot->drawn = false;
    return true;
}

/* A state that serves two pictures is drawn once. */
static bool shoot_draw(Shoot *shoot, Session *session, double time, Error *error)
{
    if (shoot->interpolates && shoot->before.state.count > 0 &&
        session->info.time > time + 1e-6 * session->scene.world.dt)
        return draw_between(shoot, session, time, error);
    if (shoot->drawn && shoot->drawn_step == session->info.step)
        return true;
    if (!studio_draw(&shoot->studio, session->world, NULL, NULL, error))
        return false;
    renderer_read(shoot->studio.renderer, shoot->image.rgb);
    shoot->drawn = true;
    shoot->drawn_step = session->info.step;
    return true;
}

/* When the pictures are taken: `count` of them, `interval` seconds apart from `first` on. */
typedef struct Schedule {
    double first, interval;
    size_t count;
} Schedule;

static Schedule make_schedule(const Args *args, PicturesKind kind)
{
    if (kind == PICTURES_PNG)
        return (Schedule){args->time, 0, 1};
    double count = args->frames ? args->frames : fmax(ceil(args->time * args->fps - 1e-6), 1);
    return (Schedule){0, 1 / args->fps, (size_t)count};
}

/* Work done by now: by simulated time, since the solver takes most of it. */
static double fraction_done(const Session *session, const Schedule *schedule, size_t pictures)
{
    double last = schedule->first + schedule->interval * (double)(schedule->count - 1);
    return last > 0 ? session->info.time / last : (double)pictures / (double)schedule->count;
}

static bool advance(Session *session, Shoot *shoot, double time, const Schedule *schedule, size_t pictures,
                    Progress *progress, Error *error)
{
    world_stop_at(session->world, time);
    while (!session_reached(session, time) && !interrupted()) {
        const bool last = session->info.time + 1.001 * session->scene.world.dt >= time;
        if (shoot->interpolates && last &&
            !still_read(&shoot->before, session->world, shoot->studio.attributes))
            return error_set(error, "out of memory for a picture between two states");
        if (!session_step(session, error))
            return false;
        progress_update(progress, fraction_done(session, schedule, pictures));
    }
    return true;
}

/* Each picture is of the first state at or after its time. After a signal only a file that has none yet gets
   one more. Returns how many there are, 0 on failure. */
static size_t take_pictures(Session *session, Shoot *shoot, Pictures *pictures, const Schedule *schedule,
                            Progress *progress, Error *error)
{
    size_t taken = 0;
    while (taken < schedule->count) {
        double time = schedule->first + schedule->interval * (double)taken;
        if (!advance(session, shoot, time, schedule, taken, progress, error))
            return 0;
        if (interrupted() && taken > 0)
            break;
        if (!shoot_draw(shoot, session, time, error) || !pictures_add(pictures, &shoot->image, error))
            return 0;
        taken++;
        progress_update(progress, fraction_done(session, schedule, taken));
    }
    return taken;
}

static int report(const Session *session, const Args *args, const Schedule *schedule, size_t taken,
                  Error *error)
{
    bool late = schedule->count == 1 && !session_reached(session, schedule->first);
    Summary summary = {.command = "render",
                       .product = "pictures",
                       .products = taken,
                       .renderer = headless_renderer(session->context),
                       .stopped = taken < schedule->count || late};
    session_report(session, args, &summary);
    if (session_write_json(session, args, &summary, error))
        return summary.stopped ? EXIT_INTERRUPTED : 0;
    fprintf(stderr, "%s\n", error->message);
    return EXIT_FAILED;
}

/* Frames of two runs in one folder would make a strange film. */
static void warn_of_older(const Pictures *pictures, size_t taken)
{
    char frame[1088];
    if (taken > 0 && pictures_has_older(pictures, frame))
        fprintf(stderr, "%s and what follows is of an earlier run; remove it unless you want both\n", frame);
}

/* What there is of pictures is of no use. */
static int fail(const Session *session, const Args *args, const Error *error)
{
    const Summary summary = {.command = "render",
                             .product = "pictures",
                             .renderer = session->context ? headless_renderer(session->context) : NULL};
    return session_fail(session, args, &summary, error);
}

static int render(Session *session, const Args *args, PicturesKind kind, Pictures *pictures, Error *error)
{
    Shoot shoot = {.drawn = false};
    Progress progress;
    Schedule schedule = make_schedule(args, kind);
    size_t taken = 0;
    if (args->interpolate && session->scene.world.step_mode == STEP_CFL)
        fprintf(stderr, "--interpolate has no effect: in mode cfl states fall on the pictures' times\n");
    if (schedule.count > 1 && !args->interpolate)
        session_tell_uneven(session, "pictures", schedule.interval);
    if (shoot_open(&shoot, session, args, error)) {
        progress_begin(&progress, stderr, "render", args->quiet);
        taken = take_pictures(session, &shoot, pictures, &schedule, &progress, error);
        progress_end(&progress);
    }
    warn_of_older(pictures, taken);
    if (taken == 0)
        pictures_discard(pictures);
    else if (!pictures_finish(pictures, error))
        taken = 0;
    const int code = taken > 0 ? report(session, args, &schedule, taken, error) : fail(session, args, error);
    shoot_close(&shoot);
    return code;
}

static bool understand(const Args *args, PicturesKind *kind, Error *error)
{
    if (!pictures_kind(args->output, kind, error))
        return false;
    return *kind != PICTURES_PNG || args->frames == 0 ||
           error_set(error,
                     "--frames makes no sense for one picture, %s; name a FILE.mp4 or a folder, or "
                     "leave --frames out",
                     args->output);
}

int cmd_render(const Args *args)
{
    Session session = {.world = NULL};
    Error error = {{0}};
    PicturesKind kind;
    Pictures *pictures = NULL;
    interrupt_install();
    int code = understand(args, &kind, &error) ? session_open(&session, args, true, &error) : EXIT_USAGE;
    if (code == EXIT_USAGE || (code == 0 && args->json && !json_file_check(args->json, &error))) {
        fprintf(stderr, "%s\n", error.message);
        code = code == 0 ? EXIT_FAILED : code;
    } else if (code != 0 ||
               !(pictures = pictures_create(args->output, args->width, args->height, args->fps, &error))) {
        code = fail(&session, args, &error);
    } else {
        code = render(&session, args, kind, pictures, &error);
    }
    session_close(&session);
    return code;
}

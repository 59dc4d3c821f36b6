/* What the window writes: pictures, videos, sessions, each under a name of its own in the present folder. */
#include "app/base/output.h"
#include "app/output/image.h"
#include "app/play/play_state.h"
#include "sim/base/stage.h"

#include <stdio.h>
#include <time.h>
#include <unistd.h>

static const double MOVIE_FPS = 30;

/* slosh-20261121-101500.png, or -2, -3, ... where that is there. */
void play_name_file(char path[1024], const char *extension)
{
    char stamp[32];
    const time_t now = time(NULL);
    struct tm local;
    strftime(stamp, sizeof stamp, "%Y%m%d-%H%M%S", localtime_r(&now, &local));
    snprintf(path, 1024, "slosh-%s.%s", stamp, extension);
    for (int i = 2; access(path, F_OK) == 0 && i < 1000; i++)
        snprintf(path, 1024, "slosh-%s-%d.%s", stamp, i, extension);
}

static bool read_picture(const Play *play, Image *image, Error *error)
{
    if (!image_create(image, play->width, play->height))
        return error_set(error, "no memory for a picture");
    renderer_read(play->renderer, image->rgb);
    return true;
}

void play_screenshot(Play *play)
{
    Image image = {0};
    Output output = {.temp = ""};
    Error error = {{0}};
    char path[1024];
    play_name_file(path, "png");
    play->shoot = false;
    if (read_picture(play, &image, &error) && output_begin(&output, path, &error) &&
        image_write(&image, output.temp, &error) && output_commit(&output, &error))
        play_tell(play, "%s: the picture", path);
    else
        play_error(play, error.message);
    output_discard(&output);
    image_destroy(&image);
}

bool play_movie_end(Play *play)
{
    PlayMovie *movie = &play->movie;
    Error error = {{0}};
    Video *video = movie->video;
    if (!video)
        return true;
    movie->video = NULL;
    if (!video_finish(video, &error)) {
        play_error(play, error.message);
        return false;
    }
    play_tell(play, "%s: the video, %.1f s", movie->path, (double)movie->pictures / MOVIE_FPS);
    return true;
}

bool play_movie_due(const Play *play)
{
    return play->movie.video && wall_ms() >= play->movie.next_ms;
}

void play_movie_toggle(Play *play)
{
    PlayMovie *movie = &play->movie;
    Error error = {{0}};
    if (movie->video) {
        play_movie_end(play);
        return;
    }
    *movie = (PlayMovie){.width = play->width, .height = play->height};
    play_name_file(movie->path, "mp4");
    movie->video = video_create(movie->path, movie->width, movie->height, MOVIE_FPS, &error);
    if (movie->video)
        play_tell(play, "%s: recording until you ask again", movie->path);
    else
        play_error(play, error.message);
    play->dirty = true;
}

/* As many times as its frames are due: a video runs at its own, even pace. What a stall of more than a second
   left out stays out. */
static bool add_due(PlayMovie *movie, const Image *image, Error *error)
{
    const double now = wall_ms();
    if (movie->pictures == 0 || movie->next_ms < now - 1000)
        movie->next_ms = now;
    while (movie->next_ms <= now) {
        if (!video_add(movie->video, image->rgb, error))
            return false;
        movie->next_ms += 1000 / MOVIE_FPS;
        movie->pictures++;
    }
    return true;
}

void play_movie_picture(Play *play)
{
    PlayMovie *movie = &play->movie;
    Image image = {0};
    Error error = {{0}};
    if (!play_movie_due(play))
        return;
    if (play->width != movie->width || play->height != movie->height) {
        play_movie_end(play);
        return;
    }
    if (!read_picture(play, &image, &error) || !add_due(movie, &image, &error)) {
        video_discard(movie->video);
        movie->video = NULL;
        play_error(play, error.message);
    }
    image_destroy(&image);
}

void play_save(Play *play)
{
    char path[1024];
    play_name_file(path, "recording");
    if (!simulator_save(play->open.simulator, path))
        play_error(play, "the session before is still being saved; try again in a moment");
}

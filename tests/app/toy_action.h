/* An action of the window in one file: a message tells the count of particles. */
#ifndef SLOSH_TESTS_TOY_ACTION_H
#define SLOSH_TESTS_TOY_ACTION_H

#include "app/window/play_private.h"

#define GLFW_INCLUDE_NONE /* numbers only */
#include <GLFW/glfw3.h>

static void toy_count(Play *play)
{
    notice_tell(&play->notice, "%zu particles are shown", play->model.particles.count);
}

static const UserAction action_count = {
    .group = "Toys",
    .example = "press F8: the picture says how many particles it shows",
    .name = "count",
    .help = "tell how many particles are shown",
    .keys = {ON(F8)},
    .flags = ACTION_BUTTON,
    .needs = ACTION_OF_STATE,
    .run = toy_count,
};

static inline void toy_action_add(void)
{
    user_action_add(&action_count);
}

#endif

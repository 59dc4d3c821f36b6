/* Scenes as text, for the tests of the loader. */
#ifndef SLOSH_TESTS_SCENE_TEXT_H
#define SLOSH_TESTS_SCENE_TEXT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "app/scene/scene.h"

/* The smallest valid scene: 500 particles. Text appended by a test starts in line 7. */
#define LEAST                                                                                                \
    "box: {size: [1, 1, 1]}\n"                                                                               \
    "particles:\n"                                                                                           \
    "  spacing: 0.1\n"                                                                                       \
    "fluids:\n"                                                                                              \
    "  - fill:\n"                                                                                            \
    "      - block: {min: [-0.5, 0, -0.5], max: [0.5, 0.5, 0.5]}\n"

static inline bool parse_text(const char *text, SceneSettings *settings, Scene *scene, Error *error)
{
    error->message[0] = 0;
    return scene_parse("scene.yaml", text, strlen(text), settings, scene, NULL, error);
}

static inline bool parse_set(const char *text, const char *setting, Scene *scene, Error *error)
{
    SceneSettings settings = {.count = 1, .set = {setting}};
    return parse_text(text, &settings, scene, error);
}

/* The text is refused with a message that begins so. */
static inline void assert_refused(const char *text, const char *message)
{
    static Scene scene;
    Error error;
    if (parse_text(text, NULL, &scene, &error))
        fail_msg("accepted, but should be refused with '%s':\n%s", message, text);
    if (strncmp(error.message, message, strlen(message)) != 0)
        fail_msg("expected '%s'\n     got '%s'", message, error.message);
    assert_true(strchr(error.message, ';') || strstr(error.message, " must ")); /* the valid choices */
}

static inline void assert_set_refused(const char *setting, const char *message)
{
    static Scene scene;
    Error error;
    char expected[512];
    snprintf(expected, sizeof expected, "--set %s: %s", setting, message);
    text_tame(expected);
    if (parse_set(LEAST, setting, &scene, &error))
        fail_msg("--set %s: accepted", setting);
    if (strncmp(error.message, expected, strlen(expected)) != 0)
        fail_msg("expected '%s'\n     got '%s'", expected, error.message);
}

#endif

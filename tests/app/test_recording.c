/* Recordings: exact, whole, refused where they are wrong; and a session that replays to the same bits. */
#include "app/recording.h"
#include "sim/world.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static Error error;
static const char scene_text[] = "box: {size: [0.4, 0.4, 0.4]}\n"
                                 "particles: {spacing: 0.05}\n"
                                 "fluids: [{fill: [{block: {min: [-0.2, 0, -0.2], max: [0.2, 0.2, 0.2]}}]}]\n"
                                 "solver: {step: {dt: 0.004, substeps: 2}}\n";

static char *write_and_slurp(const Recording *recording, uint64_t steps, uint64_t hash, size_t *size)
{
    char path[] = "/tmp/slosh-recording-XXXXXX";
    const int fd = mkstemp(path);
    assert_true(fd >= 0);
    close(fd);
    if (!recording_write(recording, steps, hash, path, &error))
        fail_msg("%s", error.message);
    FILE *file = fopen(path, "rb");
    char *bytes = malloc(1 << 20);
    *size = fread(bytes, 1, 1 << 20, file);
    fclose(file);
    unlink(path);
    return bytes;
}

static void assert_same(const Recording *a, const Recording *b)
{
    assert_string_equal(a->path, b->path);
    assert_int_equal(a->size, b->size);
    assert_memory_equal(a->text, b->text, a->size);
    assert_int_equal(a->settings.count, b->settings.count);
    assert_int_equal(a->settings.particles, b->settings.particles);
    for (int i = 0; i < a->settings.count; i++)
        assert_string_equal(a->settings.set[i], b->settings.set[i]);
    assert_int_equal(a->count, b->count);
    for (size_t i = 0; i < a->count; i++) {
        const SimCommand *x = &a->commands[i], *y = &b->commands[i];
        assert_true(x->step == y->step && x->kind == y->kind);
        if (x->kind == SIM_SET)
            assert_string_equal(x->setting, y->setting);
        else
            assert_memory_equal(&x->target, &y->target, sizeof x->target);
    }
}

/* Any bytes that a scene may have, any number, any setting. */
static void everything_comes_back(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "", "a", "a\n", "\n", "\n\n", "a\r\nb\r\n\r", "| x\n\\ y", "end 3 0x1\n", "\xc3\xa4%0a\n"};
    static const double numbers[] = {0, -0.0, DBL_MIN / 4, -DBL_MAX, 1.0 / 3, 1e-300, 123456789.123456789};
    const SceneSettings settings = {
        .count = 3, .set = {"a=1", "title='100 %\n\r'", "b=[1, %0a]"}, .particles = 77};
    for (size_t t = 0; t < sizeof texts / sizeof *texts; t++) {
        Recording recording, again;
        size_t size;
        assert_true(
            recording_create(&recording, "folder/a\nb.yaml", texts[t], strlen(texts[t]), &settings, &error));
        for (uint64_t i = 0; i < 1000; i++) {
            SimCommand command = {.step = i * i, .kind = (SimCommandKind)(i % 3)};
            if (command.kind == SIM_SET)
                snprintf(command.setting, sizeof command.setting, "gravity=[0, %d, 0]", (int)i);
            for (int k = 0; k < 7 && command.kind != SIM_SET; k++)
                (k < 3 ? command.target.position : command.target.orientation - 3)[k] =
                    numbers[(i + (uint64_t)k) % 7];
            assert_true(recording_add(&recording, &command));
        }
        char *bytes = write_and_slurp(&recording, 12345678, 0xfedcba9876543210u, &size);
        if (!recording_parse("x", bytes, size, &again, &error) && texts[t][0])
            fail_msg("%s", error.message);
        if (texts[t][0]) {
            assert_same(&recording, &again);
            assert_true(again.complete && again.steps == 12345678 && again.hash == 0xfedcba9876543210u);
        }
        recording_destroy(&again);
        recording_destroy(&recording);
        free(bytes);
    }
}

static void refuse(const char *text, const char *words)
{
    Recording out;
    assert_false(recording_parse("f", text, strlen(text), &out, &error));
    if (!strstr(error.message, words))
        fail_msg("'%s' is no '%s'", error.message, words);
    assert_null(out.text);
}

#define HEAD "slosh recording 1\nscene a\n| b: 1\n"

static void wrong_files_are_refused(void **state)
{
    (void)state;
    refuse("", "f:1: no recording");
    refuse("title: x\n", "f:1: no recording");
    refuse("slosh recording 2\n", "f:1: 'slosh recording 2' is of another version");
    refuse("slosh recording 1\n", "the scene is missing");
    refuse("slosh recording 1\nparticles -3\n| a\n", "f:2: 'particles -3'");
    refuse(HEAD "x\n", "f:4: 'x' is no command");
    refuse(HEAD "3 dance\n", "f:4: unknown command 'dance'");
    refuse(HEAD "3 target 1 2 3\n", "seven numbers");
    refuse(HEAD "3 target 1 2 3 0 0 0 nan\n", "seven numbers");
    refuse(HEAD "3 target 1 2 3 0 0 0 1 1\n", "too much");
    refuse(HEAD "3 set a=1\n2 set a=1\n", "f:5: step 2 comes after step 3");
    refuse(HEAD "99999999999999999999999 set a=1\n", "no command");
    refuse(HEAD "end 3\n", "is no end");
    refuse(HEAD "end 3 0x1\n4 set a=1\n", "something follows the end");
    refuse(HEAD "9 set a=1\nend 3 0x1\n", "before the last command");
    refuse(HEAD "1 set a=1\n| b: 2\nend 3 0x1\n", "f:5:");
}

/* A writer that was stopped: what is whole counts, and that the end is missing is known. */
static void cut_files_are_known(void **state)
{
    (void)state;
    static const char text[] = HEAD "3 set a=1\n5 set b=2\nend 9 0x7\n";
    for (size_t size = sizeof HEAD; size < sizeof text - 1; size++) {
        Recording out;
        if (!recording_parse("f", text, size, &out, &error))
            fail_msg("%s", error.message);
        assert_false(out.complete);
        assert_true(out.count <= 2);
        recording_destroy(&out);
    }
}

static World *world_of(const Recording *recording, int threads, Scene *scene)
{
    SceneSettings settings = recording->settings;
    if (!scene_parse(recording->path, recording->text, recording->size, &settings, scene, NULL, &error))
        fail_msg("%s", error.message);
    scene->world.threads = threads;
    World *world = world_create(&scene->world, &error);
    assert_non_null(world);
    return world;
}

static uint64_t replay(const Recording *recording, int threads)
{
    Scene scene;
    WorldInfo info = {.step = 0};
    size_t done = 0;
    World *world = world_of(recording, threads, &scene);
    while (info.step < recording->steps) {
        while (done < recording->count && recording->commands[done].step == info.step)
            assert_true(sim_command_apply(&recording->commands[done++], world, &scene, &error));
        assert_true(world_substep(world, NULL, &error));
        world_info(world, &info);
    }
    const uint64_t hash = world_hash(world);
    world_destroy(world);
    return hash;
}

static void a_session_replays_to_the_same_bits(void **state)
{
    (void)state;
    Scene scene;
    Recording recording, again;
    WorldInfo info;
    size_t size;
    assert_true(
        recording_create(&recording, "a", scene_text, sizeof scene_text - 1, &(SceneSettings){0}, &error));
    World *world = world_of(&recording, 1, &scene);
    for (int frame = 0; frame < 150; frame++) {
        const double t = 0.004 * frame, turn = 0.3 * sin(9 * t);
        SimCommand command = {.kind = frame == 70 ? SIM_CARRY : SIM_TARGET,
                              .target = {{0.1 * sin(20 * t), 0.02 * t, 0}, {0, 0, sin(turn), cos(turn)}}};
        world_info(world, &info);
        command.step = info.step;
        if (frame % 50 == 49) {
            command.kind = SIM_SET;
            snprintf(command.setting, sizeof command.setting, "%s",
                     frame == 49   ? "gravity=[1, -5, 0]"
                     : frame == 99 ? "solver.step.substeps=3"
                                   : "fluids[0].viscosity=2");
        }
        assert_true(sim_command_apply(&command, world, &scene, &error));
        assert_true(recording_add(&recording, &command));
        assert_true(world_step(world, NULL, &error));
    }
    world_info(world, &info);
    const uint64_t hash = world_hash(world);
    world_destroy(world);
    char *bytes = write_and_slurp(&recording, info.step, hash, &size);
    assert_true(recording_parse("f", bytes, size, &again, &error));
    assert_true(replay(&again, 1) == hash);
    assert_true(replay(&again, 2) == hash);
    again.commands[20].target.position[1] += 1e-3;
    assert_true(replay(&again, 1) != hash);
    recording_destroy(&recording);
    recording_destroy(&again);
    free(bytes);
}

static void what_cannot_be_written_says_so(void **state)
{
    (void)state;
    Recording recording;
    assert_true(recording_create(&recording, "a", "b", 1, &(SceneSettings){0}, &error));
    assert_false(recording_write(&recording, 0, 0, "/no/such/folder/x.recording", &error));
    assert_non_null(strstr(error.message, "/no/such/folder/x.recording"));
    recording_destroy(&recording);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everything_comes_back),
        cmocka_unit_test(wrong_files_are_refused),
        cmocka_unit_test(cut_files_are_known),
        cmocka_unit_test(a_session_replays_to_the_same_bits),
        cmocka_unit_test(what_cannot_be_written_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

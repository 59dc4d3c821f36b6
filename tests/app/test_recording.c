/* Recordings: a round trip is exact to the bit; errors name the line. */
#include "tests/app/output_fixture.h"

#include "app/run/recording/recording.h"
#include "app/scene/scene.h"

#include <errno.h>
#include <float.h>
#include <math.h>
#include <signal.h>
#include <sys/resource.h>

#define HEAD                                                                                                 \
    "slosh recording 1\nprogram 0.1\nscene a.yaml\ntext\n| box:\ncommands\n" /* commands begin in line 7 */
#define POSE " 0 0 0 0 0 0 1\n"
#define END  "end 8 0123456789abcdef\n"

static Error error;

static SimCommand target_at(uint64_t step, double x)
{
    return (SimCommand){step, SIM_TARGET, {.target = {{x, 0, 0}, {0, 0, 0, 1}}}};
}

static SimCommand setting_at(uint64_t step, const char *setting)
{
    SimCommand command = {step, SIM_SET, {.setting = ""}};
    snprintf(command.setting, sizeof command.setting, "%s", setting);
    return command;
}

static Recording create(const char *text, size_t size, const SceneSettings *settings)
{
    Recording recording;
    if (!recording_create(&recording, "a.yaml", text, size, settings, &error))
        fail_msg("%s", error.message);
    return recording;
}

static void add(Recording *recording, SimCommand command)
{
    assert_true(recording_add(recording, &command));
}

static Recording write_and_read(const Recording *recording, uint64_t steps, uint64_t hash)
{
    Recording out;
    if (!recording_write(recording, steps, hash, "a.rec", &error) || !recording_read("a.rec", &out, &error))
        fail_msg("%s", error.message);
    assert_int_equal(count_files("."), 1);
    assert_true(!out.cut && out.steps == steps && out.hash == hash && out.count == recording->count);
    return out;
}

static void texts_come_back(void **state)
{
    (void)state;
    char all[2 * 255];
    static const char *const texts[] = {
        "",
        "\n",
        "a",
        "a\n",
        "a\n\n",
        "\n\na",
        "a\r\nb\r\n",
        "\r",
        " a",
        "| a",
        "|\n|",
        "+ a",
        "%a\n",
        "%s%n",
        "\xc3\xa9\xe2\x82\xac",
        "\\ no newline at the end\n",
        "\t",
        "a \n",
        "a\n \n",
        "commands\nend 0 0123456789abcdef\n",
    };
    for (size_t i = 0; i < sizeof all; i++)
        all[i] = (char)(i % 255 + 1);
    for (size_t i = 0; i <= sizeof texts / sizeof *texts; i++) {
        const bool last = i == sizeof texts / sizeof *texts;
        const char *text = last ? all : texts[i];
        const size_t size = last ? sizeof all : strlen(text);
        Recording in = create(text, size, NULL), out = write_and_read(&in, 3, UINT64_MAX);
        assert_int_equal(out.size, size);
        assert_memory_equal(out.text, text, size);
        assert_string_equal(out.path, "a.yaml");
        assert_string_equal(out.program, SLOSH_VERSION);
        recording_destroy(&in);
        recording_destroy(&out);
    }
}

static void settings_come_back(void **state)
{
    (void)state;
    char full[SIM_SETTING_SIZE];
    memset(full, '=', sizeof full - 1);
    full[sizeof full - 1] = 0;
    const SceneSettings settings = {
        .particles = 2147483647,
        .count = 5,
        .set = {"gravity=[0,\n-1,\n\n2]", "solver.threads=3", "title='%d'", "", "+ \n+ \r\n"},
    };
    Recording in = create("a: b", 4, &settings);
    add(&in, setting_at(0, "gravity=[0,\n+ 1,\n\n3]"));
    add(&in, setting_at(0, ""));
    add(&in, setting_at(1, full));
    add(&in, target_at(1, 2));
    Recording out = write_and_read(&in, 4, 0);
    assert_int_equal(out.settings.particles, 2147483647);
    assert_int_equal(out.settings.count, 4); /* threads change no bit */
    for (int i = 0; i < 4; i++)
        assert_string_equal(out.settings.set[i], settings.set[i == 0 ? 0 : i + 1]);
    for (size_t i = 0; i < 3; i++)
        assert_string_equal(out.commands[i].setting, in.commands[i].setting);
    recording_destroy(&in);
    recording_destroy(&out);
}

static void numbers_come_back(void **state)
{
    (void)state;
    static const double numbers[] = {0.0,     -0.0,     DBL_TRUE_MIN, -DBL_TRUE_MIN,   DBL_MIN, 0.1,
                                     1.0 / 3, -DBL_MAX, DBL_MAX,      1 + DBL_EPSILON, -1e-300, 12345.678};
    enum { COUNT = sizeof numbers / sizeof *numbers };
    Recording in = create("", 0, NULL);
    for (size_t i = 0; i < COUNT; i++) {
        SimCommand command = {i == COUNT - 1 ? UINT64_MAX : i, i % 2 ? SIM_CARRY : SIM_TARGET, {{{0}, {0}}}};
        for (size_t k = 0; k < 7; k++)
            *(k < 3 ? &command.target.position[k] : &command.target.orientation[k - 3]) =
                numbers[(i + k) % COUNT];
        add(&in, command);
    }
    Recording out = write_and_read(&in, UINT64_MAX, 0x0123456789abcdef);
    for (size_t i = 0; i < COUNT; i++) {
        assert_true(out.commands[i].step == in.commands[i].step &&
                    out.commands[i].kind == in.commands[i].kind);
        assert_memory_equal(&out.commands[i].target, &in.commands[i].target, sizeof(BoxTarget));
    }
    recording_destroy(&in);
    recording_destroy(&out);
}

static bool parse(const char *text, Recording *out)
{
    error.message[0] = 0;
    return recording_parse("a.rec", text, strlen(text), out, &error);
}

static void people_may_write_it(void **state)
{
    (void)state;
    Recording out;
    assert_true(parse("slosh recording 1\nprogram 9.9 of mine\nscene a b\ntext\n|\n| x\ncommands\n"
                      "0 carry 0.5 -1e-3 +2 0x1p-1 .25 0 1\n" END,
                      &out));
    assert_int_equal(out.size, 3);
    assert_memory_equal(out.text, "\nx\n", 3);
    assert_string_equal(out.program, "9.9 of mine");
    assert_true(out.commands[0].kind == SIM_CARRY && out.commands[0].target.position[1] == -1e-3 &&
                out.commands[0].target.orientation[0] == 0.5);
    recording_destroy(&out);
}

static void slips_are_named(void **state)
{
    static const struct {
        const char *text, *message;
    } slips[] = {
        {"", "1: this is no recording; the first line of one is 'slosh recording 1'"},
        {"box: {}\n", "1: this is no recording; "},
        {"slosh recording 2\n",
         "1: 'slosh recording 2' stands where 'slosh recording 1', the one format that this slosh reads, must stand"},
        {"slosh recording 1\r\nprogram 1\r\n", "1: 'slosh recording 1?' stands where "},
        {"slosh recording 1", "0: the recording was cut before its commands; "},
        {"slosh recording 1\n", "1: the recording was cut before its commands; "},
        {"slosh recording 1\nscene a\n", "2: 'scene a' stands where 'program ...' must stand"},
        {"slosh recording 1\nprogram 01234567890123456789012345678901\n",
         "2: the program's version is too long; "},
        {"slosh recording 1\nprogram 1\ntext\n", "3: 'text' stands where 'scene ...' must stand"},
        {"slosh recording 1\nprogram 1\nscene a\n+ b\nparticles 0\n",
         "5: particles must be a whole number from 1 "},
        {"slosh recording 1\nprogram 1\nscene a\nparticles 3.5\n", "4: particles must be "},
        {"slosh recording 1\nprogram 1\nscene a\nset a=1\nparticles 3\n",
         "5: 'particles 3' stands where 'text' "},
        {"slosh recording 1\nprogram 1\nscene a\ntext\n|a\n", "5: no blank after the '|'; "},
        {"slosh recording 1\nprogram 1\nscene a\ntext\n| a\nb\n", "6: 'b' stands where '| ' and a line "},
        {"slosh recording 1\nprogram 1\nscene a\ntext\n\\ no newline at the end\n", "5: '\\ no newline "},
        {HEAD "target" POSE END, "7: 'target 0 0 0 0 0 0 1' is no command; it must begin with the step "},
        {HEAD "-1 target" POSE END, "7: '-1 target"},
        {HEAD "99999999999999999999 target" POSE END, "7: '99999999999999999999"},
        {HEAD "1 jump" POSE END,
         "7: ' jump 0 0 0 0 0 0 1' is no command; after the step stands target, carry, touch, shut, solid, size or "},
        {HEAD "1 target\n" END, "7: ' target' is no command"},
        {HEAD "1 target 0 0 0 0 0 0\n" END, "7: number 7 of 7 is missing or not finite; "},
        {HEAD "1 target 0  0 0 0 0 0 1\n" END, "7: number 2 of 7 "},
        {HEAD "1 target 0\t0 0 0 0 0 1\n" END, "7: number 2 of 7 "},
        {HEAD "1 target nan 0 0 0 0 0 1\n" END, "7: number 1 of 7 "},
        {HEAD "1 target 0 0 inf 0 0 0 1\n" END, "7: number 3 of 7 "},
        {HEAD "1 target 0 0 1e999 0 0 0 1\n" END, "7: number 3 of 7 "},
        {HEAD "1 target 0 0 0x 0 0 0 1\n" END, "7: number 4 of 7 "},
        {HEAD "1 target 0 0 0 0 0 0 1 2\n" END, "7: ' 2' follows the seven numbers; leave it out"},
        {HEAD "5 target" POSE "4 carry" POSE END, "8: step 4 is before step 5 of the line above; "},
        {HEAD "1 set a=1\n+ b\n0 set a=1\n" END, "9: step 0 is before step 1"},
        {HEAD "\n" END, "7: '' is no command"},
        {HEAD "9 target" POSE END, "8: the end at step 8 is before the last command's step 9; "},
        {HEAD "end 8 0123456789abcde\n", "7: the last line must be 'end STEPS HASH'"},
        {HEAD "end 8 0123456789abcdef0\n", "7: the last line must be "},
        {HEAD "end 8 0123456789ABCDEF\n", "7: the last line must be "},
        {HEAD "end x 0123456789abcdef\n", "7: the last line must be "},
        {HEAD END END, "8: something follows the end; leave it out"},
        {HEAD END "x", "8: something follows the end; leave it out"},
    };
    (void)state;
    Recording out;
    for (size_t i = 0; i < sizeof slips / sizeof *slips; i++) {
        char expected[256];
        snprintf(expected, sizeof expected, "a.rec:%s", slips[i].message);
        if (parse(slips[i].text, &out))
            fail_msg("accepted:\n%s", slips[i].text);
        if (strncmp(error.message, expected, strlen(expected)) != 0)
            fail_msg("expected '%s'\n     got '%s'", expected, error.message);
        assert_true(!out.text && !out.commands);
    }
}

static void long_ones_are_refused(void **state)
{
    (void)state;
    Recording out;
    char text[600], setting[SIM_SETTING_SIZE + 1];
    memset(setting, 'x', SIM_SETTING_SIZE);
    setting[SIM_SETTING_SIZE] = 0;
    snprintf(text, sizeof text, HEAD "0 set %s\n+ \n" END, setting);
    assert_false(parse(text, &out));
    assert_string_equal(error.message, "a.rec:7: the setting is too long; at most 191 bytes are");
    snprintf(text, sizeof text, HEAD "0 target %0300d\n" END, 0);
    assert_false(parse(text, &out));
    assert_string_equal(error.message, "a.rec:7: the line is too long; at most 255 bytes are");
}

static void too_many_settings_are_refused(void **state)
{
    (void)state;
    Recording out;
    char text[2048] = "slosh recording 1\nprogram 1\nscene a\n";
    for (int i = 0; i < SCENE_SETTINGS_MAX; i++)
        strcat(text, "set a=b\n");
    const size_t length = strlen(text);
    strcat(text, "text\ncommands\n" END);
    assert_true(parse(text, &out));
    assert_int_equal(out.settings.count, SCENE_SETTINGS_MAX);
    recording_destroy(&out);
    strcpy(text + length, "set a=b\ntext\ncommands\n" END);
    assert_false(parse(text, &out));
    assert_string_equal(error.message, "a.rec:68: more than 64 settings; write them into the scene's text");
}

static void a_byte_0_is_refused(void **state)
{
    (void)state;
    static const char text[] = HEAD "0 carry 0\0" POSE END;
    Recording out;
    assert_false(recording_parse("a.rec", text, sizeof text - 1, &out, &error));
    assert_string_equal(error.message, "a.rec:7: a byte 0 stands here; a recording is text");
    assert_false(recording_create(&out, "a.yaml", "a\0b", 3, NULL, &error));
    assert_string_equal(error.message, "a.yaml: has a byte 0; a scene is a YAML file in UTF-8");
}

static void a_large_scene_is_refused(void **state)
{
    (void)state;
    Recording out;
    char *text = malloc(SCENE_BYTES_MAX + 200);
    assert_non_null(text);
    const int head = sprintf(text, "slosh recording 1\nprogram 1\nscene a\ntext\n| ");
    memset(text + head, 'x', SCENE_BYTES_MAX + 1);
    strcpy(text + head + SCENE_BYTES_MAX + 1, "\ncommands\n" END);
    assert_false(parse(text, &out));
    assert_string_equal(error.message, "a.rec:5: the scene is larger than 1 MiB; a scene is a page of YAML");
    assert_false(recording_create(&out, "a.yaml", text, SCENE_BYTES_MAX + 1, NULL, &error));
    text[head + SCENE_BYTES_MAX - 1] = '\n'; /* the largest that a scene may be */
    strcpy(text + head + SCENE_BYTES_MAX, "commands\n" END);
    if (!parse(text, &out))
        fail_msg("%s", error.message);
    assert_int_equal(out.size, SCENE_BYTES_MAX);
    recording_destroy(&out);
    free(text);
}

/* Wherever a file is cut, it is read as cut or refused, and says so. */
static void cuts_are_seen(void **state)
{
    (void)state;
    static const char whole[] = HEAD "0 target" POSE "5 carry" POSE END;
    const size_t head = strlen(HEAD), line = strlen("0 target" POSE), last = strlen("5 carry" POSE);
    for (size_t size = 0; size < sizeof whole - 1; size++) {
        Recording out;
        if (!recording_parse("a.rec", whole, size, &out, &error)) {
            assert_true(size < head);
            continue;
        }
        assert_true(size >= head && out.cut && !out.hash);
        assert_int_equal(out.count, size < head + line ? 0 : size < head + line + last ? 1 : 2);
        assert_int_equal(out.steps, out.count == 2 ? 5 : 0);
        recording_destroy(&out);
    }
}

static void lines_are_counted(void **state)
{
    (void)state;
    Recording out;
    assert_true(parse(HEAD "0 target" POSE "0 set a=1\n+ 2\n+ 3\n1 carry" POSE END, &out));
    assert_int_equal(recording_line(&out, 0), 7);
    assert_int_equal(recording_line(&out, 1), 8);
    assert_int_equal(recording_line(&out, 2), 11);
    assert_int_equal(recording_line(&out, 3), 12);
    recording_destroy(&out);
}

static void only_what_can_be_read_is_recorded(void **state)
{
    (void)state;
    Recording recording = create("", 0, NULL);
    SimCommand command = target_at(3, 1);
    add(&recording, command);
    command.step = 2;
    assert_false(recording_add(&recording, &command));
    command = target_at(3, (double)NAN);
    assert_true(recording_add(&recording, &command)); /* refused by worlds */
    command = target_at(3, 0);
    command.target.orientation[3] = (double)INFINITY;
    assert_true(recording_add(&recording, &command));
    command = setting_at(3, "");
    memset(command.setting, 'x', sizeof command.setting);
    assert_false(recording_add(&recording, &command));
    assert_int_equal(recording.count, 1);
    recording.count = 0;
    add(&recording, target_at(1, 0));
    assert_int_equal(recording.count, 1);
    while (recording.count < RECORDING_COMMANDS_MAX)
        add(&recording, target_at(1, 0));
    assert_false(recording_add(&recording, &recording.commands[0]));
    recording_destroy(&recording);
}

static void files_are_named(void **state)
{
    (void)state;
    Recording recording = create("", 0, NULL), out;
    assert_false(recording_read("none.rec", &out, &error));
    assert_contains(error.message, "none.rec: cannot be opened (No such file");
    assert_false(recording_read(".", &out, &error));
    assert_contains(error.message, ".: a directory; ");
    assert_false(recording_write(&recording, 0, 0, "none/a.rec", &error));
    assert_contains(error.message, "none/a.rec: cannot be written: the folder none");
    recording_destroy(&recording);
}

static void a_full_disk_leaves_the_old_file(void **state)
{
    (void)state;
    Recording recording = create("", 0, NULL);
    struct rlimit old;
    for (uint64_t i = 0; i < 1000; i++)
        add(&recording, target_at(i, 0.1));
    write_text("a.rec", "old");
    signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &old);
    const struct rlimit small = {20000, old.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    const bool written = recording_write(&recording, 1000, 0, "a.rec", &error);
    setrlimit(RLIMIT_FSIZE, &old);
    assert_false(written);
    assert_string_equal(error.message, "a.rec: cannot be written: File too large; free some space, or choose "
                                       "another folder");
    assert_text("a.rec", "old");
    assert_int_equal(count_files("."), 1);
    recording_destroy(&recording);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_come_back),
        cmocka_unit_test(settings_come_back),
        cmocka_unit_test(numbers_come_back),
        cmocka_unit_test(people_may_write_it),
        cmocka_unit_test(slips_are_named),
        cmocka_unit_test(long_ones_are_refused),
        cmocka_unit_test(too_many_settings_are_refused),
        cmocka_unit_test(a_byte_0_is_refused),
        cmocka_unit_test(a_large_scene_is_refused),
        cmocka_unit_test(cuts_are_seen),
        cmocka_unit_test(lines_are_counted),
        cmocka_unit_test(only_what_can_be_read_is_recorded),
        cmocka_unit_test(files_are_named),
        cmocka_unit_test(a_full_disk_leaves_the_old_file),
    };
    return cmocka_run_group_tests(tests, folder_setup, folder_teardown);
}

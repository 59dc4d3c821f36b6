/* The panel: every live key can be set, every request is accepted, and no text is cut off at any scale. */
#include "tests/render/toy_view.h"
#include "tests/render/ui_fixture.h"
#include "tests/sim/toy_method.h"

#include "app/input/actions.h"
#include "app/scene/scene.h"
#include "app/scene/scene_private.h"
#include "app/window/panel/panel.h"
#include "render/frame/view.h"
#include "render/views/pbsr/pbsr.h"
#include "render/views/slice/slice.h"

enum { HISTORY = 120, TALL = 6000 }; /* all sections open, and room for more keys */

static const char *const sections[] = {"History",     "Stages", "Accuracy",        "Colours", "Fluids",
                                       "Solver",      "Hand",   "Touch",           "Glyphs",  "Trails",
                                       "Streamlines", "Film",   "More of the view"}; /* Play and View are open
                                                                                      */
enum { SECTIONS = sizeof sections / sizeof *sections };

/* Live keys that have no widget, and why: see elsewhere in app/window/panel/panel_keys.c. */
static const char *const without_widget[] = {"view.camera.from", "view.camera.to", "view.camera.fov"};

/* A session: the scene is changed as the window would change it. */
typedef struct Session {
    Panel *panel;
    Scene scene;
    PanelData data;
    float history[HISTORY];
    GaugeSample gauges[HISTORY];
    ProbeSample probes[HISTORY];
    bool help, watches, watches_probes;
    int settings, refused; /* in all */
    char last[SETTING_TEXT_SIZE];
    const UserAction *action; /* the last */
    GLuint none_passed;
    BoxControlDevice devices[3];
    int tuned; /* the last */
    double gain, dead_zone;
    size_t opened;    /* scenes */
    double particles; /* the last */
    char restart[64];
} Session;

static void take(Session *session, const PanelEvents *events)
{
    if (events->action)
        session->action = events->action;
    if (events->tuned) {
        session->tuned = events->tuned;
        session->gain = events->gain;
        session->dead_zone = events->dead_zone;
    }
    if (events->particles > 0)
        session->particles = events->particles;
    if (*events->restart)
        memcpy(session->restart, events->restart, sizeof session->restart);
    if (*events->term) {
        session->settings++;
        snprintf(session->last, sizeof session->last, "%s", events->term);
        assert_true(scene_set_live(&session->scene, events->term, NULL, NULL));
    }
    for (int i = 0; i < events->value_count; i++) {
        Error error = {{0}};
        SettingBefore before;
        session->settings++;
        setting_value_text(&events->values[i], session->last);
        if (!scene_set_value(&session->scene, &events->values[i], &before, NULL, &error)) {
            print_error("%s\n", error.message);
            session->refused++;
        }
    }
}

static void draw_panel(void *user, Desk *desk)
{
    Session *session = user;
    PanelEvents events;
    session->data.opened = session->opened;
    panel_draw(session->panel, desk->ui, desk->target.width, desk->target.height, &session->data, &events);
    session->data.closed_gates = events.gated ? events.closed_gates : session->data.closed_gates;
    session->watches = events.watches;
    session->watches_probes = events.watches_probes;
    take(session, &events);
    if (session->help)
        panel_help_draw(desk->ui, desk->target.width, desk->target.height);
}

static void load(Session *session, const char *name)
{
    Error error = {{0}};
    SceneSettings settings = {.count = 0};
    session->opened++;
    if (strcmp(name, "two_oils") ==
        0) /* by a view that has widgets of all kinds, and as many in each state */
        assert_true(scene_settings_add(&settings, NULL, "view.kind=spheres", &error) &&
                    scene_settings_add(&settings, NULL, "view.volume.look=opaque", &error));
    assert_true(scene_load(name, &settings, &session->scene, NULL, &error));
    pbsr_def(&session->scene.view)->layer_count = 2; /* elements of a list have widgets */
}

static void fill(Session *session)
{
    static const char *const warnings[] = {
        "The solver cannot keep up: 0.81 of real time. Fewer particles or fewer substeps would help."};
    for (int i = 0; i < HISTORY; i++) {
        session->history[i] = 12 + 5 * sinf(0.3F * (float)i);
        session->gauges[i] = (GaugeSample){.gauge = {.time = 1234 + 0.05 * i,
                                                     .density_error_mean = 1.23e-3,
                                                     .density_error_max = 0.0456,
                                                     .kinetic_energy = 1230 + i,
                                                     .potential_energy = -45600,
                                                     .compression_energy = 0.0012,
                                                     .total_known = true},
                                           .courant = 0.789,
                                           .limit = STEP_LIMIT_VISCOUS};
        session->probes[i].time = 1234 + 0.05 * i;
        for (int k = 0; k < PROBES_SHOWN; k++)
            session->probes[i].value[k] = k % 4 == 1 ? NAN : 0.1F * (float)(k + 1) + 0.001F * (float)i;
    }
    session->data = (PanelData){.scene = &session->scene,
                                .render_stages_known = true,
                                .sim_ms = 11,
                                .render_ms = 1622.5,
                                .frame_history = session->history,
                                .step_history = session->history,
                                .frame_count = HISTORY,
                                .step_count = HISTORY,
                                .gauges = session->gauges,
                                .gauge_count = HISTORY,
                                .probes = session->probes,
                                .probe_count = HISTORY,
                                .particles = 1234567,
                                .particles_at_start = 1234000,
                                .time = 1234.56,
                                .iterations = 10000,
                                .solved = {12345, 1234.5, 1279, 0.000123, 0.00456},
                                .real_time_factor = 0.81,
                                .speed = 0.015625,
                                .pictures_per_second = 59.9,
                                .realtime = true,
                                .scalar_range = {-1234.5, 102345},
                                .opacity_range = {0.5, 2.5},
                                .size_range = {-3, 7},
                                .renderer = "llvmpipe (LLVM 15.0.6, 256 bits)",
                                .warnings = warnings,
                                .warning_count = 1,
                                .panel_ms = 0.05};
    for (int i = 0; i < STAGE_COUNT; i++) {
        session->data.stage_ran[i] = true;
        session->data.stage_ms[i] = 0.3 * (i + 1) * (i + 1);
    }
}

/* Thousands of frames without a look: draws are skipped, since no sample has passed. The widgets work as
   ever. session_close ends the mode. */
static void stop_drawing(Session *session)
{
    glGenQueries(1, &session->none_passed);
    glBeginQuery(GL_ANY_SAMPLES_PASSED, session->none_passed);
    glEndQuery(GL_ANY_SAMPLES_PASSED);
    glBeginConditionalRender(session->none_passed, GL_QUERY_WAIT);
}

static Desk *session_open(Session *session, const char *scene, int width, int height, float pixels)
{
    Desk *desk = calloc(1, sizeof *desk);
    assert_non_null(desk);
    desk_open(desk, width, height, pixels);
    *session = (Session){.panel = panel_create()};
    assert_non_null(session->panel);
    load(session, scene);
    fill(session);
    stop_drawing(session);
    desk->draw = draw_panel;
    desk->user = session;
    desk_frames(desk, 30);
    return desk;
}

static void session_close(Session *session, Desk *desk)
{
    glEndConditionalRender();
    glDeleteQueries(1, &session->none_passed);
    panel_destroy(session->panel);
    desk_close(desk);
    free(desk);
}

static void open_sections(Desk *desk)
{
    for (int i = 0; i < SECTIONS; i++)
        desk_click_at(desk, sections[i], 0.3F);
}

static Desk *all_open(Session *session, const char *scene)
{
    Desk *desk = session_open(session, scene, 700, TALL, 13);
    open_sections(desk);
    return desk;
}

static bool has_widget(const Key *key)
{
    if (key->type == KEY_TEXT)
        return false;
    for (size_t i = 0; i < sizeof without_widget / sizeof *without_widget; i++)
        if (strcmp(key->path, without_widget[i]) == 0)
            return false;
    return true;
}

/* "fluids[].color" of the second fluid; different paths unchanged. */
static void in_second_fluid(const char *path, char out[64])
{
    const char *list = strstr(path, "[]");
    if (list)
        snprintf(out, 64, "%.*s[1]%s", (int)(list - path), path, list + 2);
    else
        snprintf(out, 64, "%s", path);
}

/* Curves and ranges of what goes by no scalar have no effect, and no widgets. */
static void set_curves(Session *session, Desk *desk)
{
    assert_true(scene_set_live(&session->scene, "view.opacity.by=density", NULL, NULL));
    assert_true(scene_set_live(&session->scene, "view.size.by=density", NULL, NULL));
    desk->input.changed = true;
    desk_frames(desk, 10);
}

/* Automatic ones have no sliders. */
static void set_ranges(Scene *scene)
{
    for (int k = 0; k < KEY_SCALARS; k++) {
        char setting[64];
        snprintf(setting, sizeof setting, "%s=[0, 2]", key_scalars[k].range);
        assert_true(scene_set_live(scene, setting, NULL, NULL));
    }
}

/* The panel shows keys of the current view only: a key of a different view needs a change of view. */
static void show_view_of(Session *session, Desk *desk, const char *path)
{
    for (int i = 0; view_at(i); i++) {
        char own[64];
        snprintf(own, sizeof own, "view.%s.", view_at(i)->name);
        if (strncmp(path, own, strlen(own)) != 0 || strcmp(session->scene.view.kind, view_at(i)->name) == 0)
            continue;
        snprintf(session->scene.view.kind, NAME_SIZE, "%s", view_at(i)->name);
        desk->input.changed = true;
        desk_frames(desk, 10);
    }
}

static void test_the_shown_view_has_its_keys_and_no_other(void **state)
{
    (void)state;
    Session session;
    Desk *desk = session_open(&session, "two_oils", 700, TALL, 13);
    assert_non_null(desk_find(desk, "view.kind")); /* open at first */
    assert_null(desk_find(desk, "view.splat.weights"));
    assert_true(desk_find(desk, "View")->rect[1] < desk_find(desk, "Colours")->rect[1]);
    show_view_of(&session, desk, "view.volume.look");
    assert_null(desk_find(desk, "view.radius")); /* of its shadows alone: further below */
    show_view_of(&session, desk, "view.splat.weights");
    assert_non_null(desk_find(desk, "view.radius"));
    desk_click_at(desk, "More of the view", 0.3F);
    assert_non_null(desk_find(desk, "view.splat.weights"));
    assert_null(desk_find(desk, "view.volume.look"));
    assert_null(desk_find(desk, "view.trails.show")); /* under a heading of its own */
    desk_click_at(desk, "Trails", 0.3F);
    assert_non_null(desk_find(desk, "view.trails.show"));
    session_close(&session, desk);
}

/* Play is first and open; the view says what the picture is, and the rest comes on request. */
static void test_what_one_plays_with_is_first(void **state)
{
    (void)state;
    Session session;
    Desk *desk = session_open(&session, "two_oils", 700, TALL, 13);
    const float view = desk_find(desk, "View")->rect[1];
    static const char *const first[] = {"gravity", "fluids[0].viscosity", "fluids[1].viscosity",
                                        "again.particles", "again.honey"};
    for (size_t i = 0; i < sizeof first / sizeof *first; i++) {
        assert_non_null(desk_find(desk, first[i]));
        assert_true(desk_find(desk, first[i])->rect[1] < view);
    }
    assert_non_null(desk_find(desk, "view.quality"));
    assert_null(desk_find(desk, "view.legend"));
    desk_click_at(desk, "More of the view", 0.3F);
    assert_non_null(desk_find(desk, "view.legend"));
    session_close(&session, desk);
}

/* Sizes of particles act in views of particles alone. */
static void test_keys_without_an_effect_are_left_out(void **state)
{
    (void)state;
    Session session;
    Desk *desk = all_open(&session, "two_oils");
    static const char *const own[] = {"view.splat.weights", "view.slice.cut"};
    for (int i = 0; i < 2; i++) {
        show_view_of(&session, desk, own[i]);
        assert_int_equal(desk_find(desk, "view.size.by") != NULL, i == 0);
        assert_non_null(desk_find(desk, "view.color_by"));
    }
    session_close(&session, desk);
}

/* Both ends of a range of 0 to 1. */
static void test_a_small_range_is_spanned(void **state)
{
    (void)state;
    Session session;
    Desk *desk = all_open(&session, "two_oils");
    show_view_of(&session, desk, "view.slice.cut");
    desk_click_at(desk, "view.slice.cut", 0.002F);
    assert_true(slice_def(&session.scene.view)->cut < 0.01);
    desk_click_at(desk, "view.slice.cut", 0.995F);
    if (slice_def(&session.scene.view)->cut < 0.98)
        fail_msg("%g", slice_def(&session.scene.view)->cut);
    session_close(&session, desk);
}

/* Nothing moves when warnings come, however many and long. */
static void test_warnings_move_nothing(void **state)
{
    (void)state;
    static const char *const many[] = {
        "A warning so long that it has no room in two lines of the panel, which is why it ends in three dots there, and "
        "stands whole below all the rest of it, where nothing can be moved by it.",
        "Another one."};
    Session session;
    Desk *desk = all_open(&session, "two_oils");
    session.data.warning_count = 0;
    desk_frames(desk, 30);
    const float view = desk_find(desk, "View")->rect[1],
                last = desk_find(desk, "picture to picture")->rect[1];
    session.data.warnings = many;
    session.data.warning_count = 2;
    desk_frames(desk, 30);
    assert_true(desk_find(desk, "View")->rect[1] == view);
    assert_true(desk_find(desk, "picture to picture")->rect[1] == last);
    assert_true(desk_find(desk, many[1])->rect[1] > last);
    session_close(&session, desk);
}

static void test_every_live_key_has_a_widget(void **state)
{
    (void)state;
    int count, live = 0;
    const Key *keys = scene_keys(&count);
    Session session;
    Desk *desk = all_open(&session, "two_oils");
    set_curves(&session, desk);
    set_ranges(&session.scene);
    desk_frames(desk, 30);
    for (int i = 0; i < count; i++) {
        char path[64];
        in_second_fluid(keys[i].path, path);
        const bool live_key = keys[i].flags & KEY_LIVE && has_widget(&keys[i]);
        /* "box" is also a name for "view.box", "solids" also a stage */
        if (keys[i].type == KEY_MAPPING || keys[i].type == KEY_LIST)
            continue;
        show_view_of(&session, desk, path);
        const bool expected = live_key && scene_key_works(&session.scene, path);
        if ((desk_find(desk, path) != NULL) != expected)
            fail_msg("%s: %s", path, expected ? "live, without a widget" : "has a widget");
        live += expected;
    }
    assert_true(live > 100);
    session_close(&session, desk);
}

/* Result of a click on the widget: the value, or an opened list or picker. */
static void click_for_change(Desk *desk, const Key *key, const char *path, float share)
{
    desk_click_at(desk, path, share);
    if (key->type == KEY_POINTS)
        desk_click_at(desk, path, share); /* twice: a new point */
    const Seen *seen = desk_find(desk, path);
    const float line = seen->rect[3] - seen->rect[1], middle = (seen->rect[0] + seen->rect[2]) / 2;
    if (key->type == KEY_CHOICE)
        desk_click(desk, seen->rect[0] + 10, seen->rect[3] + 1.5F * line);
    if (key->type == KEY_COLOR)
        desk_click(desk, middle + 60, seen->rect[3] + 60);
    if (key->type == KEY_CHOICE || key->type == KEY_COLOR)
        desk_click(desk, 395, TALL - 5); /* closes the list */
}

static void test_what_it_asks_for_is_accepted(void **state)
{
    (void)state;
    int count;
    const Key *keys = scene_keys(&count);
    Session session;
    Desk *desk = all_open(&session, "two_oils");
    set_curves(&session, desk);
    set_ranges(&session.scene);
    desk_frames(desk, 30);
    for (int i = 0; i < count; i++) {
        static const float shares[] = {0.005F, 0.3F, 0.62F, 0.995F};
        char path[64];
        in_second_fluid(keys[i].path, path);
        show_view_of(&session, desk, path);
        if (!desk_find(desk, path) || !(keys[i].flags & KEY_LIVE))
            continue;
        const int before = session.settings;
        for (int k = 0; k < 4; k++)
            click_for_change(desk, &keys[i], path, shares[k]);
        if (session.settings == before && key_choice(&keys[i], 0) && !key_choice(&keys[i], 2))
            continue; /* a list with at most two entries, the second maybe already chosen */
        if (session.settings == before || strncmp(session.last, path, strlen(path)) != 0)
            fail_msg("%s: asks for nothing, or for %s", path, session.last);
    }
    assert_int_equal(session.refused, 0);
    session_close(&session, desk);
}

static void type_into(Desk *desk, const char *path, const char *text)
{
    desk->input.keys = UI_KEY_CTRL;
    desk_click_at(desk, path, 0.1F);
    desk->input.keys = 0;
    desk_frames(desk, 3);
    assert_true(ui_wants_keys(desk->ui));
    desk_type(desk, text);
    desk_key(desk, UI_KEY_ENTER);
}

/* Whatever is typed comes out in the key's range. */
static void test_typed_numbers_are_accepted(void **state)
{
    (void)state;
    static const char *const typed[] = {"-1e300", "0.333333333", "1e300"};
    int count, tried = 0;
    const Key *keys = scene_keys(&count);
    Session session;
    Desk *desk = all_open(&session, "two_oils");
    for (int i = 0; i < count; i++) {
        char path[64];
        in_second_fluid(keys[i].path, path);
        show_view_of(&session, desk, path);
        if (!desk_find(desk, path) ||
            (keys[i].type != KEY_NUMBER && keys[i].type != KEY_INTEGER && keys[i].type != KEY_VEC3))
            continue;
        for (size_t k = 0; k < sizeof typed / sizeof *typed; k++)
            type_into(desk, path, typed[k]);
        tried++;
    }
    assert_true(tried > 10 && session.settings >= 2 * tried);
    assert_int_equal(session.refused, 0);
    assert_true(session.scene.world.dt == 100);
    session_close(&session, desk);
}

static void test_one_click_one_value(void **state)
{
    (void)state;
    Session session;
    Desk *desk = all_open(&session, "two_oils");
    set_curves(&session, desk);
    desk_click_at(desk, "fluids[0].viscosity", 0.5F);
    assert_true(fabs(session.scene.world.fluids[0].viscosity - 0.8) < 0.05); /* the start is in the middle */
    desk_click_at(desk, "fluids[1].viscosity", 0.995F);
    assert_true(fabs(session.scene.world.fluids[1].viscosity - 3) < 0.1); /* ten times the start */
    desk_click_at(desk, "solver.step.realtime", 0.5F);
    assert_false(session.scene.realtime);
    desk_click_at(desk, "gravity", 0.5F);
    assert_true(fabs(session.scene.world.gravity[1]) < 1 && session.scene.world.gravity[0] == 0);
    desk_click_at(desk, "view.range.auto", 0.5F);
    assert_string_equal(session.last, "view.range=[-1234.5, 102345]");
    desk_click_at(desk, "view.range.auto", 0.5F);
    assert_true(session.scene.view.range_auto);
    desk_click_at(desk, "view.size.range.auto", 0.5F);
    assert_string_equal(session.last, "view.size.range=[-3, 7]");
    desk_click_at(desk, "view.opacity.range.auto", 0.5F);
    assert_string_equal(session.last, "view.opacity.range=[0.5, 2.5]");
    assert_int_equal(session.refused, 0);
    session_close(&session, desk);
}

/* In the panel as in a scene; eight points are asked for whole. */
static void test_curves_are_drawn_by_hand(void **state)
{
    (void)state;
    Session session;
    Desk *desk = all_open(&session, "two_oils");
    set_curves(&session, desk);
    const ControlPoints *curve = &session.scene.view.opacity.curve;
    for (int k = 1; k < 7; k++)
        for (int twice = 0; twice < 2; twice++)
            desk_click_at(desk, "view.opacity.curve", 0.14F * (float)k);
    assert_int_equal(curve->count, CONTROL_POINTS_MAX);
    assert_true(fabs(curve->y[1] - 0.5) < 0.05 && curve->x[1] > 0.05 && curve->x[1] < 0.25);
    desk_click_at(desk, "view.opacity.curve.preset", 0.5F);
    const Seen *seen = desk_find(desk, "view.opacity.curve.preset");
    desk_click(desk, seen->rect[0] + 10, seen->rect[3] + 1.5F * (seen->rect[3] - seen->rect[1]));
    assert_string_equal(session.last, "view.opacity.curve=falling");
    assert_true(curve->count == 2 && curve->y[0] == 1);
    assert_int_equal(session.refused, 0);
    session_close(&session, desk);
}

static void test_sliders_follow_another_scene(void **state)
{
    (void)state;
    Session session;
    Desk *desk = all_open(&session, "two_oils");
    load(&session, "box_slosh");
    desk->input.changed = true;
    desk_frames(desk, 10);
    assert_null(desk_find(desk, "fluids[1].viscosity"));
    desk_click_at(desk, "fluids[0].viscosity", 0.995F);
    assert_true(fabs(session.scene.world.fluids[0].viscosity - 50) < 2);
    session_close(&session, desk);
}

static void test_buttons_are_the_actions(void **state)
{
    (void)state;
    Session session;
    int buttons = 0;
    Desk *desk = session_open(&session, "box_slosh", 1280, 720, 13);
    for (const UserAction *const *at = user_actions; *at; at++) {
        const bool button = (*at)->flags & ACTION_BUTTON;
        if ((desk_find(desk, (*at)->name) != NULL) != button)
            fail_msg("action %s: %s", (*at)->name, button ? "no button" : "a button");
        if (!button)
            continue;
        session.action = NULL;
        desk_click_at(desk, (*at)->name, 0.5F);
        assert_ptr_equal(session.action, *at);
        buttons++;
    }
    assert_true(buttons > 8);
    session_close(&session, desk);
}

/* A row of each kind, and a row that cannot be opened. */
static void add_devices(Session *session)
{
    static const char *const names[] = {"SpaceMouse Pro Wireless (Bluetooth)", "DualSense Edge",
                                        "DualShock 4"};
    static const DeviceFamily families[] = {DEVICE_SPACEMOUSE, DEVICE_DUALSENSE, DEVICE_DUALSHOCK4};
    Mapping mapping;
    mapping_default(&mapping);
    for (int i = 0; i < 3; i++) {
        BoxControlDevice *device = &session->devices[i];
        *device = (BoxControlDevice){.number = i + 1,
                                     .family = families[i],
                                     .map = mapping.family[families[i]],
                                     .has_pose = i > 0,
                                     .turned = {0.5, -0.5, 0, sqrt(0.5)},
                                     .down = {0.5, -sqrt(0.75), 0},
                                     .resting = true,
                                     .axes = {0.5, -1, 0.02, 1, -0.7, 0.3}};
        snprintf(device->name, sizeof device->name, "%s", names[i]);
    }
    snprintf(session->devices[2].problem, sizeof session->devices[2].problem,
             "permission denied; sudo install -m 644 tools/70-slosh.rules /etc/udev/rules.d/");
    session->data.devices = session->devices;
    session->data.device_count = 3;
}

static void test_motion_devices(void **state)
{
    (void)state;
    Session session;
    Desk *desk = session_open(&session, "box_slosh", 700, 1600, 13);
    assert_null(desk_find(desk, "Motion device"));
    add_devices(&session);
    desk->input.changed = true;
    desk_frames(desk, 10);
    assert_non_null(desk_find(desk, "Motion device"));
    assert_non_null(desk_find(desk, "DualSense Edge"));
    assert_non_null(desk_find(desk,
                              "DualShock 4: permission denied; sudo install -m 644 tools/70-slosh.rules "
                              "/etc/udev/rules.d/"));
    assert_null(desk_find(desk, "device 3 gain"));
    assert_non_null(desk_find(desk, "30° from level, at rest"));
    desk_click_at(desk, "device 2 gain", 0.5F);
    assert_int_equal(session.tuned, 2);
    assert_true(fabs(session.gain - 1.5) < 0.1 && session.dead_zone == 0.1);
    desk_click_at(desk, "device 1 dead zone", 0.5F);
    assert_int_equal(session.tuned, 1);
    assert_true(fabs(session.dead_zone - 0.25) < 0.02 && session.gain == 1);
    session_close(&session, desk);
}

static void test_the_scene_begins_anew(void **state)
{
    (void)state;
    static Session session;
    Desk *desk = session_open(&session, "two_oils", 700, TALL, 13);
    desk_click_at(desk, "again.honey", 0.5F);
    assert_string_equal(session.restart, "preset=honey:0");
    desk_click_at(desk, "again.fast", 0.5F);
    assert_string_equal(session.restart, "preset=fast");
    desk_click_at(desk, "again.particles", 0.75F);
    assert_true(session.particles > 1234000 && session.particles < 16 * 1234000);
    assert_int_equal(session.settings, 0);
    session_close(&session, desk);
}

static void test_stages_as_they_are_known(void **state)
{
    (void)state;
    Session session;
    Desk *desk = session_open(&session, "box_slosh", 1280, 1600, 13);
    assert_null(desk_find(desk, "visibility")); /* closed at first */
    desk_click_at(desk, "Stages", 0.3F);
    assert_non_null(desk_find(desk, "visibility"));
    assert_non_null(desk_find(desk, "density"));
    assert_null(desk_find(desk, "all rendering"));
    session.data.render_stages_known = false;
    session.data.stage_ran[STAGE_GRID] = false;
    desk_frames(desk, 30);
    assert_null(desk_find(desk, "visibility"));
    assert_null(desk_find(desk, "grid"));
    assert_non_null(desk_find(desk, "all rendering"));
    assert_non_null(desk_find(desk, session.data.warnings[0]));
    assert_non_null(desk_find(desk, "1,234,567"));
    desk_click(desk, 60, 25); /* its title hides all below */
    assert_null(desk_find(desk, "density"));
    session_close(&session, desk);
}

/* The driver's calls, below the stages, with a GPU alone. */
static void test_calls_of_a_gpu(void **state)
{
    (void)state;
    Session session;
    Desk *desk = session_open(&session, "box_slosh", 1280, 1600, 13);
    for (int i = 0; i < STAGE_COUNT; i++)
        session.data.stage_ran[i] = i == STAGE_GRID; /* leaves room */
    desk_click_at(desk, "Stages", 0.3F);
    assert_null(desk_find(desk, "dispatches")); /* without a GPU */
    session.data.substep_calls = (GlCalls){.calls = 1618, .dispatches = 273, .waits = 14, .readbacks = 51};
    desk_frames(desk, 30);
    assert_non_null(desk_find(desk, "dispatches"));
    assert_non_null(desk_find(desk, "1618"));
    assert_non_null(desk_find(desk, "273"));
    assert_non_null(desk_find(desk, "14"));
    assert_non_null(desk_find(desk, "51"));
    assert_null(desk_find(desk, "picture"));
    session.data.picture_calls = (GlCalls){.calls = 99};
    desk_frames(desk, 30);
    assert_non_null(desk_find(desk, "picture"));
    assert_non_null(desk_find(desk, "99"));
    session_close(&session, desk);
}

/* Numbers with units, ranges and limits; past values under the mouse. */
static void test_gauges_are_plotted(void **state)
{
    (void)state;
    static const char *const shown[] = {"0 % to 4.56 %, last 5.95 s",
                                        "mean 0.123 %",
                                        "max 4.56 %",
                                        "-45.6 kJ to 1.35 kJ, last 5.95 s",
                                        "kinetic 1.35 kJ",
                                        "potential -45.6 kJ",
                                        "total -44.3 kJ",
                                        "0 to 0.789, last 5.95 s",
                                        "0.789, bounded by viscous"};
    Session session;
    Desk *desk = session_open(&session, "box_slosh", 1280, 1600, 13);
    assert_false(session.watches); /* closed at first: nothing is measured */
    desk_click_at(desk, "Accuracy", 0.3F);
    desk_frames(desk, 3);
    for (size_t i = 0; i < sizeof shown / sizeof *shown; i++)
        if (!desk_find(desk, shown[i]))
            fail_msg("%s is not shown", shown[i]);
    assert_true(session.watches);
    const Seen *kinetic = desk_find(desk, "kinetic 1.35 kJ"), *row = desk_find(desk, "energy");
    desk_move(desk, kinetic->rect[0] + 1, (row->rect[3] + kinetic->rect[1]) / 2);
    assert_non_null(desk_find(desk, "at 1234 s"));
    assert_non_null(desk_find(desk, "kinetic 1.23 kJ"));
    for (int i = 0; i < HISTORY; i++)
        session.gauges[i].gauge.total_known = false;
    desk_move(desk, 700, 1500);
    desk->input.changed = true;
    desk_frames(desk, 30);
    assert_non_null(desk_find(desk, "potential -45.6 kJ"));
    assert_null(desk_find(desk, "total -44.3 kJ"));
    session.data.gauge_count = 0;
    desk_frames(desk, 30);
    assert_non_null(desk_find(desk, "no values yet"));
    desk_click_at(desk, "Accuracy", 0.3F);
    assert_false(session.watches); /* unwatched: not measured */
    assert_null(desk_find(desk, "energy"));
    session_close(&session, desk);
}

/* A plot per probe, with name and values with units, or "dry"; no plot for a scene without probes. */
static void test_probes_are_plotted(void **state)
{
    (void)state;
    static const char *const shown[] = {"low",
                                        "100 mPa to 219 mPa, last 5.95 s",
                                        "pressure 219 mPa",
                                        "pressure dry",
                                        "column",
                                        "400 mm to 519 mm, last 5.95 s",
                                        "height 519 mm",
                                        "runup",
                                        "flow",
                                        "1.speed 819 mm/s"};
    Session session;
    Desk *desk = session_open(&session, "impact", 1280, 2000, 13);
    for (size_t i = 0; i < sizeof shown / sizeof *shown; i++)
        if (!desk_find(desk, shown[i]))
            fail_msg("%s is not shown", shown[i]);
    assert_true(session.watches_probes);
    desk_click_at(desk, "Probes", 0.3F);
    assert_false(session.watches_probes);
    assert_null(desk_find(desk, "runup"));
    session_close(&session, desk);
    desk = session_open(&session, "box_slosh", 1280, 1000, 13);
    assert_null(desk_find(desk, "Probes"));
    assert_false(session.watches_probes);
    session_close(&session, desk);
}

static void assert_nothing_is_cut(const Desk *desk)
{
    int cut = 0;
    assert_true(desk->seen_count > 40);
    for (int i = 0; i < desk->seen_count; i++) {
        const Seen *seen = &desk->seen[i];
        const float room = seen->rect[2] - seen->rect[0];
        const bool fits = seen->needed <= room + 1.5F && /* places are rounded */
                          seen->rect[0] >= 0 && seen->rect[2] <= (float)desk->target.width;
        if (!fits)
            print_error("%s: needs %g of %g pixels\n", seen->id, (double)seen->needed, (double)room);
        cut += !fits;
    }
    assert_int_equal(cut, 0);
}

static void test_nothing_is_cut_at_any_scale(void **state)
{
    (void)state;
    static const float scales[] = {1, 1.5F, 2, 3};
    for (int i = 0; i < 4; i++) {
        Session session;
        Desk *desk = session_open(&session, "two_oils", (int)(700 * scales[i]), (int)(1800 * scales[i]),
                                  13 * scales[i]);
        open_sections(desk);
        add_devices(&session);
        session.help = true;
        desk_frames(desk, 30);
        assert_nothing_is_cut(desk);
        session_close(&session, desk);
    }
}

/* As narrow as it gets, with all sections, and each view's own keys. */
static void test_nothing_is_cut_in_a_narrow_panel(void **state)
{
    (void)state;
    static const char *const scenes[] = {"two_oils", "box_slosh", "melt"};
    static const float letters[] = {13, 20, 26};
    for (int i = 0; i < 3; i++) {
        Session session;
        Desk *desk = session_open(&session, scenes[i], (int)(420 * letters[i] / 13), TALL, letters[i]);
        open_sections(desk);
        add_devices(&session);
        for (int v = 0; view_at(v); v++) {
            snprintf(session.scene.view.kind, sizeof session.scene.view.kind, "%s", view_at(v)->name);
            desk->input.changed = true;
            desk_frames(desk, 6);
            assert_nothing_is_cut(desk);
        }
        session_close(&session, desk);
    }
}

/* A live switch is switched off and on to the same value; a different key shows a hint. */
static void test_terms_have_switches(void **state)
{
    (void)state;
    Session session;
    Desk *desk = session_open(&session, "two_oils", 700, TALL, 13);
    panel_destroy(session.panel);
    session.panel = panel_create(); /* a new start */
    session.scene.world.wall_slip = SLIP_NONE;
    desk_frames(desk, 30);
    assert_null(desk_find(desk, "term fluids[1].viscosity")); /* closed */
    desk_click_at(desk, "Terms", 0.3F);
    desk_frames(desk, 30);
    const double viscosity = session.scene.world.fluids[1].viscosity;
    assert_true(viscosity > 0);
    desk_click_at(desk, "term fluids[1].viscosity", 0.1F);
    assert_true(session.scene.world.fluids[1].viscosity == 0);
    assert_true(session.scene.world.fluids[0].viscosity > 0);
    desk_frames(desk, 30);
    desk_click_at(desk, "term fluids[1].viscosity", 0.1F);
    assert_true(session.scene.world.fluids[1].viscosity == viscosity);
    assert_int_equal(session.settings, 2);
    assert_int_equal(session.refused, 0);
    assert_non_null(desk_find(desk, "box slip none: needs a new start to go, with --set box.slip=free"));
    assert_nothing_is_cut(desk);
    session_close(&session, desk);
    desk = session_open(&session, "impact", 700, TALL, 13); /* long names */
    desk_click_at(desk, "Terms", 0.3F);
    desk_frames(desk, 30);
    assert_non_null(desk_find(desk, "solver artificial viscosity 0.02: needs a new start to go, with --set "
                                    "solver.artificial_viscosity=0"));
    assert_nothing_is_cut(desk);
    session_close(&session, desk);
}

/* An emitter is shut and opened again; where nothing flows there are no switches. */
static void test_gates_have_switches(void **state)
{
    (void)state;
    Session session;
    Desk *desk = session_open(&session, "two_oils", 700, TALL, 13);
    desk_frames(desk, 30);
    assert_null(desk_find(desk, "Flow"));
    session_close(&session, desk);
    desk = session_open(&session, "fountain", 700, TALL, 13);
    desk_frames(desk, 30);
    for (uint64_t shut = 1; shut <= 1; shut--) {
        desk_click_at(desk, "fluids[0].emit[0]", 0.5F);
        desk_frames(desk, 30);
        assert_true(session.data.closed_gates == shut);
    }
    assert_nothing_is_cut(desk);
    session_close(&session, desk);
}

/* A value is set again whole, however long it is, or has no switch. */
static void test_a_long_term_comes_back(void **state)
{
    (void)state;
    static const char table[] = "fluids[1].viscosity=[[0, 0.11], [1, 0.12], [2, 0.13], [3, 0.14], [4, 0.15]]";
    Session session;
    Desk *desk = session_open(&session, "two_oils", 700, TALL, 13);
    panel_destroy(session.panel);
    session.panel = panel_create();
    assert_true(scene_set_live(&session.scene, table, NULL, NULL));
    desk_frames(desk, 30);
    desk_click_at(desk, "Terms", 0.3F);
    for (int twice = 0; twice < 2; twice++) {
        desk_frames(desk, 30);
        desk_click_at(desk, "term fluids[1].viscosity", 0.1F);
    }
    assert_string_equal(session.last, table);
    assert_int_equal(session.settings, 2);
    assert_int_equal(session.refused, 0);
    session_close(&session, desk);
}

static void test_small_windows_scroll(void **state)
{
    (void)state;
    Session session;
    Desk *desk = session_open(&session, "two_oils", 640, 360, 13);
    assert_nothing_is_cut(desk);
    assert_true(desk_find(desk, "History")->rect[1] > 360);
    desk_move(desk, 100, 200);
    for (int i = 0; i < 20; i++) {
        desk->input.wheel = -1;
        desk_frame(desk);
    }
    desk_frames(desk, 3);
    assert_true(desk_find(desk, "History")->rect[3] < 350);
    desk_click_at(desk, "History", 0.3F);
    assert_non_null(desk_find(desk, "picture to picture"));
    session_close(&session, desk);
}

static void test_help_lists_every_row(void **state)
{
    (void)state;
    Session session;
    Desk *desk = session_open(&session, "box_slosh", 640, 360, 13);
    session.help = true;
    desk->input.changed = true;
    desk_frames(desk, 30);
    for (const UserAction *const *at = user_actions; *at; at++) {
        char keys[80];
        user_action_keys(*at, keys, sizeof keys);
        assert_non_null(desk_find(desk, (*at)->help));
        assert_non_null(desk_find(desk, keys));
        assert_true(!(*at)->example || desk_find(desk, (*at)->example));
    }
    assert_nothing_is_cut(desk);
    assert_true(ui_covers(desk->ui, 320, 180) && ui_covers(desk->ui, 600, 340));
    session_close(&session, desk);
}

int main(void)
{
    toy_method_add();
    toy_view_add();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_the_shown_view_has_its_keys_and_no_other, no_gl_errors),
        cmocka_unit_test_teardown(test_what_one_plays_with_is_first, no_gl_errors),
        cmocka_unit_test_teardown(test_keys_without_an_effect_are_left_out, no_gl_errors),
        cmocka_unit_test_teardown(test_a_small_range_is_spanned, no_gl_errors),
        cmocka_unit_test_teardown(test_warnings_move_nothing, no_gl_errors),
        cmocka_unit_test_teardown(test_every_live_key_has_a_widget, no_gl_errors),
        cmocka_unit_test_teardown(test_what_it_asks_for_is_accepted, no_gl_errors),
        cmocka_unit_test_teardown(test_typed_numbers_are_accepted, no_gl_errors),
        cmocka_unit_test_teardown(test_one_click_one_value, no_gl_errors),
        cmocka_unit_test_teardown(test_curves_are_drawn_by_hand, no_gl_errors),
        cmocka_unit_test_teardown(test_sliders_follow_another_scene, no_gl_errors),
        cmocka_unit_test_teardown(test_buttons_are_the_actions, no_gl_errors),
        cmocka_unit_test_teardown(test_motion_devices, no_gl_errors),
        cmocka_unit_test_teardown(test_the_scene_begins_anew, no_gl_errors),
        cmocka_unit_test_teardown(test_stages_as_they_are_known, no_gl_errors),
        cmocka_unit_test_teardown(test_calls_of_a_gpu, no_gl_errors),
        cmocka_unit_test_teardown(test_gauges_are_plotted, no_gl_errors),
        cmocka_unit_test_teardown(test_probes_are_plotted, no_gl_errors),
        cmocka_unit_test_teardown(test_nothing_is_cut_at_any_scale, no_gl_errors),
        cmocka_unit_test_teardown(test_nothing_is_cut_in_a_narrow_panel, no_gl_errors),
        cmocka_unit_test_teardown(test_terms_have_switches, no_gl_errors),
        cmocka_unit_test_teardown(test_gates_have_switches, no_gl_errors),
        cmocka_unit_test_teardown(test_a_long_term_comes_back, no_gl_errors),
        cmocka_unit_test_teardown(test_small_windows_scroll, no_gl_errors),
        cmocka_unit_test_teardown(test_help_lists_every_row, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}

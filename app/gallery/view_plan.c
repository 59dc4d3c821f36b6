#include "app/gallery/view_plan.h"

#include "app/scene/keys.h"

#include <stdlib.h>
#include <string.h>

static const char KIND[] = "view.kind=";

static bool add_setting(SceneSettings *settings, const char *said, const char *set, Error *error)
{
    if (settings->count == SCENE_SETTINGS_MAX)
        return error_set(error, "more than %d settings; write them into a scene file", SCENE_SETTINGS_MAX);
    settings->said[settings->count] = said;
    settings->set[settings->count++] = set;
    return true;
}

static bool load(const ViewPlan *plan, const ViewJob *job, Scene *scene, Notes *notes, Error *error)
{
    SceneSettings settings = *plan->settings;
    char kind[NAME_SIZE + sizeof KIND];
    snprintf(kind, sizeof kind, "%s%s", KIND, job->kind->name);
    bool ok = add_setting(&settings, NULL, kind, error) &&
              add_setting(&settings, NULL, "view.legend=false", error) &&
              add_setting(&settings, NULL, "view.box=false", error);
    for (int i = 0; ok && i < job->set_count; i++)
        ok = add_setting(&settings, job->set[i], job->set[i] + strlen("--set "), error);
    return ok && scene_load(plan->scene, &settings, scene, notes, error);
}

bool view_job_scene(const ViewPlan *plan, const ViewJob *job, Scene *scene, Error *error)
{
    return load(plan, job, scene, NULL, error);
}

static void value_of(const Scene *scene, const char *path, char value[VIEW_SET_NAME])
{
    key_value_text(scene_key_find(path), scene, value, VIEW_SET_NAME);
}

static bool in_effect(const ViewGrade *grade, const Scene *scene)
{
    char value[VIEW_SET_NAME];
    if (!grade->where)
        return true;
    value_of(scene, grade->where, value);
    return strcmp(value, grade->value) == 0;
}

static bool number_of(const char *text, double *number)
{
    char *end;
    *number = strtod(text, &end);
    return end != text && !*end;
}

/* Returns the coarsest or finest value of a grade; the scene's own value if beyond the grade or not
   comparable. */
static const char *end_of(const ViewGrade *grade, const char *now, bool finest)
{
    int count = 0, at = -1;
    double own, first, last;
    for (; grade->values[count]; count++)
        at = strcmp(grade->values[count], now) == 0 ? count : at;
    if (count == 0)
        return now;
    const char *low = grade->values[0], *high = grade->values[count - 1];
    if (!number_of(now, &own) || !number_of(low, &first) || !number_of(high, &last))
        return at < 0 ? now : finest ? high : low;
    const double beyond = finest ? (own - last) * (last - first) : (first - own) * (last - first);
    return beyond > 0 ? now : finest ? high : low;
}

/* Adds a setting to the job; if `named`, job->name gets the last part of the key's path. */
static bool job_set(ViewJob *job, const char *path, const char *value, bool named)
{
    const char *last = strrchr(path, '.') + 1;
    if (job->set_count == VIEW_SETS)
        return false;
    snprintf(job->set[job->set_count++], VIEW_SET_NAME, "--set %.40s=%.30s", path, value);
    if (named)
        snprintf(job->name, sizeof job->name, "%.40s=%.30s", last, value);
    return true;
}

static bool add_job(ViewPlan *plan, const ViewJob *job, Error *error)
{
    if (plan->count == VIEW_JOBS_MAX)
        return error_set(error, "more than %d pictures; name one view by --set view.kind=...", VIEW_JOBS_MAX);
    plan->jobs[plan->count++] = *job;
    return true;
}

/* True if the plan has a job of the view with the same settings. */
static bool have_job(const ViewPlan *plan, const ViewJob *job)
{
    for (int i = 0; i < plan->count; i++) {
        const ViewJob *other = &plan->jobs[i];
        bool same = other->kind == job->kind && !other->reference && other->set_count == job->set_count;
        for (int k = 0; same && k < job->set_count; k++)
            same = strcmp(other->set[k], job->set[k]) == 0;
        if (same)
            return true;
    }
    return false;
}

/* Sets all keys to one end; returns true if any differs from the scene. */
static bool all_at(ViewJob *job, const Scene *scene, bool finest)
{
    bool other = false;
    for (const ViewGrade *grade = job->kind->grades; grade && grade->path; grade++) {
        char now[VIEW_SET_NAME];
        value_of(scene, grade->path, now);
        const char *value = grade->alike ? now : end_of(grade, now, finest);
        if (!in_effect(grade, scene) || strcmp(value, now) == 0)
            continue;
        other |= job_set(job, grade->path, value, false);
    }
    return other;
}

static bool plan_grade(ViewPlan *plan, const ViewKind *kind, const ViewGrade *grade, const Scene *scene,
                       Error *error)
{
    char now[VIEW_SET_NAME];
    bool ok = true;
    value_of(scene, grade->path, now);
    for (int v = 0; ok && grade->values[v] && in_effect(grade, scene); v++) {
        ViewJob job = {.kind = kind};
        if (strcmp(grade->values[v], now) == 0)
            continue;
        job_set(&job, grade->path, grade->values[v], true);
        ok = add_job(plan, &job, error);
    }
    return ok;
}

static bool plan_view(ViewPlan *plan, const ViewKind *kind, Error *error)
{
    static Scene scene;
    ViewJob job = {.kind = kind, .name = "as it is"}, reference = {.kind = kind, .reference = true};
    ViewJob coarse = {.kind = kind, .name = "all coarsest"}, fine = {.kind = kind, .name = "all finest"};
    if (!view_job_scene(plan, &job, &scene, error))
        return false;
    all_at(&reference, &scene, true);
    bool ok = add_job(plan, &reference, error) && add_job(plan, &job, error);
    for (const ViewGrade *grade = kind->grades; ok && grade && grade->path; grade++)
        ok = plan_grade(plan, kind, grade, &scene, error);
    if (ok && all_at(&coarse, &scene, false) && !have_job(plan, &coarse)) /* may equal a single grade */
        ok = add_job(plan, &coarse, error);
    if (ok && all_at(&fine, &scene, true) && !have_job(plan, &fine))
        ok = add_job(plan, &fine, error);
    return ok;
}

/* Keeps the notes common to all views: a key read by one view has an effect. */
static bool keep_common(const ViewPlan *plan, const ViewKind *kind, bool first, Notes *common, Error *error)
{
    static Scene scene;
    static Notes notes;
    const ViewJob job = {.kind = kind};
    int kept = 0;
    if (!load(plan, &job, &scene, &notes, error))
        return false;
    if (first) {
        *common = notes;
        return true;
    }
    for (int i = 0; i < common->count; i++)
        if (notes_have(&notes, common->line[i]))
            memmove(common->line[kept++], common->line[i], NOTE_SIZE);
    common->count = kept;
    return true;
}

/* Returns the view named on the command line, or NULL. */
static const char *named_view(const SceneSettings *settings)
{
    const char *name = NULL;
    for (int i = 0; i < settings->count; i++)
        if (strncmp(settings->set[i], KIND, strlen(KIND)) == 0)
            name = settings->set[i] + strlen(KIND);
    return name;
}

bool view_plan_make(const Args *args, ViewPlan *plan, Error *error)
{
    *plan = (ViewPlan){.scene = args->scenes[0], .settings = &args->settings};
    const char *name = named_view(&args->settings);
    static Notes common;
    int views = 0;
    bool ok = true;
    for (int i = 0; ok && view_at(i); i++)
        if (!name || strcmp(view_at(i)->name, name) == 0)
            ok = keep_common(plan, view_at(i), views++ == 0, &common, error) &&
                 plan_view(plan, view_at(i), error);
    if (ok && views > 0)
        notes_print(&common, stderr);
    return ok && (plan->count > 0 ||
                  error_set(error, "slosh chart: the view %s draws no fluid; name another, or none", name));
}

#include "app/ablate/ablate_report.h"

#include "app/base/file.h"

#include <math.h>

/* Formats "12.3 %", or "-" if unknown. */
static const char *percent(double part, char text[32])
{
    if (isfinite(part))
        snprintf(text, 32, "%.3g %%", 100 * part);
    else
        snprintf(text, 32, "-");
    return text;
}

static const char *number(double value, char text[32])
{
    if (isfinite(value))
        snprintf(text, 32, "%.4g", value);
    else
        snprintf(text, 32, "-");
    return text;
}

static void print_row(const Ablation *ablation, int i, FILE *file)
{
    const AblateRow *row = &ablation->row[i];
    const AblateAdvice advice = ablate_advice(ablation, i);
    char name[2 * TERM_SIZE], ms[32], seconds[32], saved[32], noise[32], instructions[32], change[32];
    if (i == 0)
        snprintf(name, sizeof name, "the whole scene");
    else
        snprintf(name, sizeof name, "%.44s %.16s", row->term, row->value);
    fprintf(file, "%-34s %10s %10s", name, number(ablate_ms_step(row), ms),
            number(ablate_seconds(row), seconds));
    if (i == 0) {
        fputc('\n', file);
        return;
    }
    fprintf(file, " %9s %9s %9s %9s  %s\n", percent(ablate_saved(ablation, i), saved),
            percent(ablate_noise(ablation, i), noise), percent(ablate_counted(ablation, i), instructions),
            percent(row->change, change), ablate_advice_word(advice));
    if (row->outcome.kind != ablation->row[0].outcome.kind) {
        char text[OUTCOME_TEXT];
        fprintf(file, "  without it: %s\n",
                row->outcome.kind == OUTCOME_NONE && !*row->outcome.words
                    ? "not run"
                    : outcome_text(&row->outcome, text));
    }
}

static void print_help(const Ablation *ablation, FILE *file)
{
    bool said[ABLATE_ADVICE_COUNT] = {false};
    for (int i = 1; i < ablation->count; i++) {
        const AblateAdvice advice = ablate_advice(ablation, i);
        if (!said[advice])
            fprintf(file, "%s: %s\n", ablate_advice_word(advice), ablate_advice_help(advice));
        said[advice] = true;
    }
}

void ablate_print(const Ablation *ablation, FILE *file)
{
    fprintf(file, "%s  %s  %s  %zu particles at the start  %g s each\n", ablation->scene, ablation->backend,
            ablation->method, ablation->particles, ablation->time);
    if (ablation->count <= 1) {
        fprintf(file, "the scene has no term that it could do without\n\n");
        return;
    }
    fprintf(file, "%-34s %10s %10s %9s %9s %9s %9s\n", "without", "ms a step", "s a sim. s", "saves", "+-",
            "instr.", "changes");
    for (int i = 0; i < ablation->count; i++)
        print_row(ablation, i, file);
    if (isfinite(ablation->floor))
        fprintf(file, "repeats of the whole scene, moved by 1e-6 of a spacing, change by %.3g %%\n",
                100 * ablation->floor);
    if (*ablation->not_counted)
        fprintf(file, "no instructions: %s\n", ablation->not_counted);
    else if (isfinite(ablation->row[0].instructions))
        fprintf(file, "instructions: %.4g a step at %zu particles, in the first steps, on one thread\n",
                ablation->row[0].instructions, ablation->counted_particles);
    print_help(ablation, file);
    fputc('\n', file);
}

static json_t *row_json(const Ablation *ablation, int i)
{
    const AblateRow *row = &ablation->row[i];
    json_t *json = json_pack(
        "{s:s, s:s, s:s, s:s*, s:I, s:f, s:s?, s:i, s:o, s:o, s:o, s:o}", "scene", ablation->scene, "method",
        ablation->method, "backend", ablation->backend, "renderer",
        *ablation->renderer ? ablation->renderer : NULL, "particles", (json_int_t)ablation->particles, "time",
        ablation->time, "term", i > 0 ? row->term : NULL, "runs", row->runs, "ms_step",
        number_json(ablate_ms_step(row)), "seconds_per_second", number_json(ablate_seconds(row)),
        "steps_per_second", number_json(row->runs > 0 ? row->steps : (double)NAN), "instructions_step",
        number_json(row->instructions));
    outcome_json(json, &row->outcome);
    if (json && i == 0) {
        json_object_set_new(json, "floor", number_json(ablation->floor));
        json_object_set_new(json, "terms", json_integer(ablation->count - 1));
        if (*ablation->not_counted)
            json_object_set_new(json, "no_instructions", json_string(ablation->not_counted));
    } else if (json) {
        json_object_set_new(json, "value", json_string(row->value));
        json_object_set_new(json, "off", json_string(row->off));
        json_object_set_new(json, "saves", number_json(ablate_saved(ablation, i)));
        json_object_set_new(json, "noise", number_json(ablate_noise(ablation, i)));
        json_object_set_new(json, "saves_instructions", number_json(ablate_counted(ablation, i)));
        json_object_set_new(json, "changes", number_json(row->change));
        json_object_set_new(json, "advice", json_string(ablate_advice_word(ablate_advice(ablation, i))));
    }
    return json;
}

bool ablate_write_json(const Ablation *ablations, size_t count, const char *path, Error *error)
{
    json_t *rows = json_array();
    bool ok = rows != NULL;
    for (size_t a = 0; a < count; a++)
        for (int i = 0; ok && i < ablations[a].count; i++)
            ok = json_array_append_new(rows, row_json(&ablations[a], i)) == 0;
    const bool written = json_file_write(ok ? rows : NULL, path, error);
    json_decref(rows);
    return written;
}

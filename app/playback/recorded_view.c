/* Checks which views a recorded file has enough attributes for. */
#include "app/playback/recorded.h"
#include "render/derived/derived.h"
#include "render/frame/overlay.h"

#include <stdio.h>
#include <string.h>

/* ---- attributes (PARTICLE_*) needed by a part of a view but missing in the file ---- */

/* If the file has times of birth, ids are not needed to find them. */
static unsigned lacks_scalar(const Recorded *recorded, Scalar scalar)
{
    const ParticleWants wants = {.scalars = SCALAR_BIT(scalar)};
    const unsigned needs = wants_attributes(&wants);
    return needs & ~(recorded->attributes | (needs & PARTICLE_SCALAR(SCALAR_BORN) ? PARTICLE_ID : 0));
}

static unsigned lacks_color(const Recorded *recorded, const ViewDef *view)
{
    return strcmp(view->kind, "none") == 0 ? 0 : lacks_scalar(recorded, view_color_by(view));
}

/* Screen-door transparency needs ids. */
static unsigned lacks_opacity(const Recorded *recorded, const ViewDef *view)
{
    return view->opacity.by == 0 ? 0
                                 : lacks_scalar(recorded, scalar_of_curve(&view->opacity)) |
                                       (PARTICLE_SCALAR(SCALAR_ID) & ~recorded->attributes);
}

static unsigned lacks_size(const Recorded *recorded, const ViewDef *view)
{
    return view->size.by == 0 ? 0 : lacks_scalar(recorded, scalar_of_curve(&view->size));
}

static OverlayShow *show_of(const ViewDef *view, const OverlayKind *kind)
{
    return overlay_own(view, kind);
}

static unsigned lacks_overlay(const Recorded *recorded, const ViewDef *view, const OverlayKind *kind)
{
    ParticleWants wants = {.scalars = 0};
    if (!show_of(view, kind)->show)
        return 0;
    kind->wants(view, &wants);
    return wants_attributes(&wants) & ~recorded->attributes;
}

/* ---- in words ---- */

static void name_first(unsigned attributes, char words[64])
{
    int scalar = 0;
    while (scalar < SCALAR_STATE_COUNT && !(attributes & PARTICLE_SCALAR(scalar)))
        scalar++;
    snprintf(words, 64, "%s",
             attributes & PARTICLE_VELOCITY                            ? "velocities"
             : attributes & PARTICLE_SCALAR(SCALAR_BORN)               ? "times of birth (born)"
             : attributes & (PARTICLE_ID | PARTICLE_SCALAR(SCALAR_ID)) ? "ids"
             : scalar < SCALAR_STATE_COUNT                             ? scalar_name((Scalar)scalar)
                                                                       : "fluids");
}

static bool needs(const Recorded *recorded, const char *key, unsigned lacks, Error *error)
{
    char words[64];
    name_first(lacks, words);
    return error_set(error, "%s: view.%s needs %s, which the file has not", recorded->path, key, words);
}

static bool no_color(const Recorded *recorded, Scalar scalar, Error *error)
{
    char known[512] = "";
    for (int s = 0; s < SCALAR_COUNT; s++)
        if (!lacks_scalar(recorded, (Scalar)s))
            snprintf(known + strlen(known), sizeof known - strlen(known), "%s%s", *known ? ", " : "",
                     scalar_name((Scalar)s));
    return error_set(error, "%s: has no %s to colour by; view.color_by may be %s", recorded->path,
                     scalar_name(scalar), known);
}

/* ---- whole view ---- */

bool recorded_has(const Recorded *recorded, const ViewDef *view, Error *error)
{
    char key[64];
    unsigned lacks;
    if (lacks_color(recorded, view))
        return no_color(recorded, view_color_by(view), error);
    if ((lacks = lacks_opacity(recorded, view)))
        return needs(recorded, "opacity.by", lacks, error);
    if ((lacks = lacks_size(recorded, view)))
        return needs(recorded, "size.by", lacks, error);
    for (int i = 0; overlay_list[i]; i++)
        if ((lacks = lacks_overlay(recorded, view, overlay_list[i]))) {
            snprintf(key, sizeof key, "%s.show", overlay_list[i]->name);
            return needs(recorded, key, lacks, error);
        }
    return true;
}

void recorded_adapt(const Recorded *recorded, ViewDef *view, Notes *notes)
{
    Error why = {{0}};
    while (!recorded_has(recorded, view, &why)) {
        const bool color = lacks_color(recorded, view);
        notes_add(notes, "%.300s; %s", why.message, color ? "coloured by fluid" : "left out");
        if (color)
            view->color_by = SCALAR_FLUID;
        else if (lacks_opacity(recorded, view))
            view->opacity.by = 0;
        else if (lacks_size(recorded, view))
            view->size.by = 0;
        else
            for (int i = 0; overlay_list[i]; i++)
                if (lacks_overlay(recorded, view, overlay_list[i]))
                    show_of(view, overlay_list[i])->show = false;
    }
}

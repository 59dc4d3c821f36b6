/* Emitters and drains: each is open or shut. */
#include "sim/matter/flow.h"
#include "app/panel/panel_parts.h"

#include <stdio.h>

static void draw_gate(Ui *ui, const PanelData *data, int gate, const char *label, PanelEvents *events)
{
    char id[GATE_NAME_SIZE];
    bool open = !gate_shut(events->gated ? events->shut : data->shut, gate);
    gate_name(gate, id);
    const UiField field = {id, label, "open, or shut from the next step on"};
    if (!ui_checkbox(ui, &field, &open))
        return;
    events->shut = (events->gated ? events->shut : data->shut) ^ 1ULL << gate;
    events->gated = true;
}

void panel_flow(Ui *ui, const PanelData *data, PanelEvents *events)
{
    const WorldDef *def = &data->scene->world;
    char label[NAME_SIZE + 32];
    if ((!flow_emits(def) && def->drain_count == 0) || !ui_section(ui, "Flow", true))
        return;
    for (int f = 0; f < def->fluid_count; f++)
        for (int i = 0; i < def->fluids[f].emit_count; i++) {
            snprintf(label, sizeof label, "%s, emitter %d", def->fluids[f].name, i + 1);
            draw_gate(ui, data, gate_of_emitter(f, i), label, events);
        }
    for (int k = 0; k < def->drain_count; k++) {
        snprintf(label, sizeof label, "drain %d", k + 1);
        draw_gate(ui, data, gate_of_drain(k), label, events);
    }
}

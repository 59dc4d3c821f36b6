#include "app/beside/lacks.h"

void lacks_take(Lacks *lacks, const Panels *panels, const ParticleBuffers *const states[])
{
    lacks->panels = panels_count(panels);
    lacks->drawn++;
    for (int i = 0; i < lacks->panels; i++) {
        struct PanelLacks *of = &lacks->of[i];
        const char *words = renderer_lacks(panels_renderer(panels, i));
        if (words && of->pictures++ == 0) {
            of->first = states[i]->time;
            snprintf(of->words, sizeof of->words, "%s", words);
        }
    }
}

void lacks_print(const Lacks *lacks, const char *output, FILE *file)
{
    for (int i = 0; i < lacks->panels; i++) {
        const struct PanelLacks *of = &lacks->of[i];
        if (of->pictures == 0)
            continue;
        fprintf(file, "%s: warning: ", output);
        if (lacks->panels > 1)
            fprintf(file, "panel %d: ", i + 1);
        if (lacks->drawn > 1)
            fprintf(file, "%zu of %zu pictures are not as asked, the first at %.4g s: ", of->pictures,
                    lacks->drawn, of->first);
        fprintf(file, "%s\n", of->words);
    }
}

#include "app/base/suggest.h"

#include <limits.h>
#include <string.h>

enum { WORD_MAX = 48 };

static int least(int a, int b)
{
    return a < b ? a : b;
}

int edit_distance(const char *a, const char *b)
{
    /* After: Damerau, "A technique for computer detection and correction of spelling errors", 1964. */
    const size_t n = strlen(a), m = strlen(b);
    if (n > WORD_MAX || m > WORD_MAX)
        return strcmp(a, b) == 0 ? 0 : INT_MAX;
    int d[WORD_MAX + 1][WORD_MAX + 1];
    for (size_t i = 0; i <= n; i++)
        for (size_t j = 0; j <= m; j++) {
            if (i == 0 || j == 0) {
                d[i][j] = (int)(i + j);
                continue;
            }
            d[i][j] = least(least(d[i - 1][j], d[i][j - 1]) + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = least(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[n][m];
}

Suggestion suggest_for(const char *word)
{
    return (Suggestion){.word = word, .distance = INT_MAX};
}

void suggest_offer(Suggestion *suggestion, const char *name)
{
    const int distance = edit_distance(suggestion->word, name);
    const size_t length = strlen(suggestion->word);
    const int allowed = length < 4 ? 0 : (int)(length / 3);
    if (distance <= allowed && distance < suggestion->distance) {
        suggestion->best = name;
        suggestion->distance = distance;
    }
}

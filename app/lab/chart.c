#include "app/lab/chart.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/wait.h>

static bool has_ending(const char *path, const char *ending)
{
    const char *dot = strrchr(path, '.');
    return dot && strcasecmp(dot, ending) == 0;
}

bool chart_name(const char *path, Error *error)
{
    return has_ending(path, ".svg") || has_ending(path, ".png") ||
           error_set(error, "'%s' is no name for a chart; name a FILE.svg or a FILE.png", path);
}

bool chart_table_name(const char *path, char table[1024], Error *error)
{
    if (!chart_name(path, error))
        return false;
    if (strlen(path) >= 1024)
        return error_set(error, "the name of the chart has more than %d bytes; name a shorter one", 1023);
    snprintf(table, 1024, "%s", path);
    memcpy(strrchr(table, '.'), ".csv", sizeof ".csv");
    return true;
}

void chart_quote(FILE *gnuplot, const char *text)
{
    fputc('\'', gnuplot);
    for (; *text; text++)
        fputs(*text == '\'' ? "''" : (char[]){*text, '\0'}, gnuplot);
    fputc('\'', gnuplot);
}

static bool not_installed(const char *path, Error *error)
{
    return error_set(error, "%s: gnuplot, which draws charts, is not installed; install gnuplot-nox", path);
}

bool chart_check(const char *path, Error *error)
{
    return system("command -v gnuplot >/dev/null 2>&1") == 0 || not_installed(path, error);
}

bool chart_begin(Chart *chart, const char *path, int width, int height, Error *error)
{
    if (!chart_name(path, error) || !output_begin(&chart->output, path, error))
        return false;
    chart->gnuplot = popen("gnuplot", "w");
    if (!chart->gnuplot) {
        output_discard(&chart->output);
        return error_set(error, "%s: gnuplot cannot be started; install gnuplot-nox", path);
    }
    fprintf(chart->gnuplot, "set terminal %s size %d,%d font 'DejaVu Sans,11' background '#ffffff'\n",
            has_ending(path, ".svg") ? "svg" : "pngcairo", width, height);
    fputs("set encoding utf8\nset output ", chart->gnuplot);
    chart_quote(chart->gnuplot, chart->output.temp);
    fputs("\nset border 3 lc '#5a6672'\nset tics nomirror textcolor '#2a3440'\n"
          "set grid lc '#d8dee4' lt 1\nset key outside right top noenhanced\n"
          "set linetype 1 lc '#2a6f97'\nset linetype 2 lc '#e07a3f'\nset linetype 3 lc '#4f9d69'\n"
          "set linetype 4 lc '#b0457b'\nset linetype 5 lc '#c9a227'\nset linetype 6 lc '#5b5ea6'\n"
          "set linetype 7 lc '#7a4f2a'\nset linetype 8 lc '#35a7a0'\nset linetype 9 lc '#c0392b'\n"
          "set linetype 10 lc '#8795a3'\nset linetype cycle 10\nset title noenhanced\n",
          chart->gnuplot);
    return true;
}

/* gnuplot reports no full disk: returns true if the file has the ending bytes of its format. */
static bool is_whole(const Chart *chart)
{
    static const char svg[] = "</svg>", png[] = "IEND\xae\x42\x60\x82";
    const char *end = has_ending(chart->output.path, ".svg") ? svg : png;
    char tail[16] = "";
    FILE *file = fopen(chart->output.temp, "rb");
    if (!file)
        return false;
    const bool read =
        fseek(file, -(long)(sizeof tail - 1), SEEK_END) == 0 && fread(tail, 1, sizeof tail - 1, file) > 0;
    fclose(file);
    for (size_t i = 0; read && i + strlen(end) < sizeof tail; i++)
        if (memcmp(tail + i, end, strlen(end)) == 0)
            return true;
    return false;
}

bool chart_end(Chart *chart, Error *error)
{
    enum { NOT_FOUND = 127 }; /* the shell's exit code of a missing command */
    fputs("set output\n", chart->gnuplot);
    const int code = pclose(chart->gnuplot);
    const char *path = chart->output.path;
    chart->gnuplot = NULL;
    if (code == 0 && is_whole(chart))
        return output_commit(&chart->output, error);
    output_discard(&chart->output);
    if (WIFEXITED(code) && WEXITSTATUS(code) == NOT_FOUND)
        return not_installed(path, error);
    if (code == 0)
        return error_set(error, "%s: gnuplot could not write it whole; is the disk full?", path);
    return error_set(error, "%s: gnuplot could not draw it (status %d)", path, code);
}

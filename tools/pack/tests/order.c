/* Calls, constants that are read by index and by name, tables of functions, equal functions, variables of all kinds. */
#include <math.h>
#include <stdio.h>

static int zeros[3];
static int start[2] = { 20, 22 };
static _Thread_local int own;

__attribute__((noinline)) static double first(double x) { return x * 1.25 + 3.5; }
__attribute__((noinline)) static double second(double x) { return x * 1.25 + 3.5; }
__attribute__((noinline)) static double third(double x) { return first(x) * 7.75 - second(x); }
__attribute__((noinline)) static float pick(int i) { return i ? 0.375f : 4.5f; }
__attribute__((noinline)) static int count(void) { return ++zeros[1] + ++own; }
int nobody_s(void) { return 41; }

static double (*const table[])(double) = { first, second, third };

int main(int argc, char **argv) {
    (void)argv;
    for (int i = 0; i < 3; i++)
        printf("%g ", table[i](argc + i));
    int n = count() + count();
    printf("%g %g %d %d %g\n", pick(argc), pick(argc - 1), n, start[0] + start[argc], floor(argc + 0.5));
    return 0;
}

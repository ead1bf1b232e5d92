/* What a rewriter must not mix up: memory that may be the same, flags, vectors, tables of jumps, parts of registers. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#define APART __attribute__((noinline))

APART static int overlap(int *a, int *b, char *c) {
    *a = 3;
    *b = *a + 4;
    c[1] = 9;
    int x = *a;
    *a = *b + x;
    return *a * 5 + *b + c[0];
}

APART static uint32_t flags(uint64_t a, uint64_t b, int8_t c) {
    uint64_t sum = a + b;
    uint32_t carry = sum < a;
    int8_t low = (int8_t)(c + 100);
    return carry * 7 + (low < c) * 3 + (a > b ? 1 : 2) + (a * 3 == b);
}

APART static int jump(int x) {
    switch (x) {
    case 0: return 10;
    case 1: return x * 77;
    case 2: return printf("two ");
    case 3: return x - 1000;
    case 4: return x << 9;
    case 5: return ~x;
    case 6: return x * x * x;
    default: return -1;
    }
}

APART static void blend(float *restrict to, const float *a, const float *b, float t, int n) {
    for (int i = 0; i < n; i++) {
        float u = t * t * (3.0f - 2.0f * t) + b[i] * 0.25f;
        to[i] = a[i] * (1.0f - u) + b[i] * u + fmaxf(a[i], b[i]) * a[i] * u + sqrtf(fabsf(b[i] * a[i] + u));
    }
}

APART static uint32_t mix(uint32_t n) {
    uint32_t s = n * 747796405u + 2891336453u;
    uint32_t w = ((s >> ((s >> 28) + 4)) ^ s) * 277803737u;
    return (w >> 22) ^ w;
}

int main(void) {
    int a[4] = {1, 2, 3, 4};
    printf("%d %d ", overlap(a, a, (char *)a), overlap(a, a + 1, (char *)(a + 1)));
    for (int i = -1; i < 8; i++) printf("%d ", jump(i));
    printf("%u %u\n", flags(~0ull, 5, 50), flags(5, 15, -3));
    float x[100], y[100], z[100];
    uint32_t sum = 0;
    for (int i = 0; i < 100; i++) {
        x[i] = (float)(mix(i) >> 8) * 1e-7f;
        y[i] = (float)(mix(i + 100) >> 8) * 1e-7f - 0.5f;
    }
    for (int k = 0; k < 50; k++) {
        blend(z, x, y, k * 0.02f, 99 - k);
        for (int i = 0; i < 50; i++) {
            uint32_t bits;
            memcpy(&bits, &z[i], 4);
            sum = mix(sum ^ bits);
        }
    }
    printf("%u %.9g\n", sum, z[7]);
    return 0;
}

/* Runs functions that were written at random, and prints what they leave in registers and in memory. */
#include <stdint.h>
#include <stdio.h>

#define COUNT 64

/* Writes to all registers that a call may write to, and to nothing else. */
__asm__(".globl clobber\nclobber:\n"
        "movq $11, %rax\nmovq $12, %rcx\nmovq $13, %rdx\nmovq $14, %rsi\nmovq $15, %rdi\nmovq $16, %r8\nmovq $17, %r9\n"
        "movq $18, %r10\nmovq $19, %r11\nvpcmpeqd %ymm0, %ymm0, %ymm0\nvpaddd %ymm0, %ymm0, %ymm1\n"
        "vpaddd %ymm1, %ymm0, %ymm2\nvpaddd %ymm2, %ymm0, %ymm3\nretq\n");

extern void (*const subjects[COUNT])(uint64_t *);

int main(void) {
    for (int n = 0; n < COUNT; n++) {
        for (uint64_t seed = 1; seed < 9; seed++) {
            uint64_t memory[64];
            for (int i = 0; i < 64; i++) memory[i] = (seed * 64 + i) * 0x9E3779B97F4A7C15u;
            subjects[n](memory);
            uint64_t hash = 0;
            for (int i = 0; i < 64; i++) hash = (hash ^ memory[i]) * 0x100000001B3u;
            printf("%016llx\n", (unsigned long long)hash);
        }
    }
    return 0;
}

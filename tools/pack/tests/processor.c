// Ends with 0 on a processor that has FMA but no AVX2.
int main(void) { return !__builtin_cpu_supports("fma") || __builtin_cpu_supports("avx2"); }

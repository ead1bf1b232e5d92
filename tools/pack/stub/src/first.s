// The first stage, alone in the file as it is: sees that no part of the file is missing, makes memory, decodes the second
// stage into it, sees that it is whole and goes there, with the stack as the kernel left it. What is coded is described in
// the packer (src/first.rs).
//
//   rdi  byte being decoded: its bits so far below a leading one
//   rbx  the contexts to come, eight bits each: one for each of the bytes before
//   ebp  range; r10d  value within it; r12d  address of the next coded bit
//   r8d  weighted count of zeros, then of all; r9d  of ones
.pushsection .first, "ax"
.globl _start
_start:
    // Is all of this file there? A part that is missing cannot be read without SIGBUS. MADV_POPULATE_READ tells (EFAULT)
    // from Linux 5.14 on; before, it is an error of another kind.
    mov     edi, {base}
    mov     esi, [rdi + 96]
    push    22
    pop     rdx
    push    28
    pop     rax
    syscall
    cmp     al, -14
    je      8f
    // mmap: readable, writable and executable; private, fixed, anonymous.
    mov     edi, offset memory
    mov     esi, offset memory_length
    push    7
    pop     rdx
    push    0x32
    pop     r10
    xor     r9d, r9d
    push    9
    pop     rax
    syscall
    test    eax, eax
    js      8f
    // MADV_HUGEPAGE: pages of 2 MB save time, those of this stage a 25th of it. Where it is refused, nothing is lost.
    push    14
    pop     rdx
    push    28
    pop     rax
    syscall
    // Eight zeros precede the second stage.
    add     edi, 8
    push    rdi
    // A range of one bit, so that the first bits are read like all others.
    push    1
    pop     rbp
    xor     r10d, r10d
    mov     r12d, offset packed_bits
next_byte:
    inc     byte ptr [rdi]
next_bit:
    push    {prior}
    pop     r8
    mov     r9d, r8d
    movabs  rbx, {contexts}
next_context:
    push    rdi
    pop     rsi
    // The hash begins with all contexts to come: with one alone, it would be another one's for other bits.
    mov     eax, ebx
    mov     edx, ebx
    push    1
    pop     rcx
2:  lea     ecx, [rcx + rcx * 2]
    xor     al, [rsi]
    imul    eax, eax, {multiplier}
3:  dec     esi
    add     dl, dl
    jc      2b
    jnz     3b
    shr     eax, 32 - {table_bits}
    lea     eax, [rax * 4 + counts]
    push    rax
    movzx   edx, word ptr [rax]
    imul    edx, ecx
    add     r9d, edx
    movzx   edx, word ptr [rax + 2]
    imul    edx, ecx
    add     r8d, edx
    shr     rbx, 8
    jnz     next_context
    // rbx is zero from here on.
4:  test    ebp, ebp
    js      5f
    bt      dword ptr [rbx], r12d
    adc     r10d, r10d
    inc     r12d
    add     ebp, ebp
    jmp     4b
5:  add     r8d, r9d
    mov     eax, ebp
    mul     r9d
    div     r8d
    cmp     r10d, eax
    sbb     edx, edx
    jc      6f
    sub     r10d, eax
    xchg    eax, ebp
    sub     eax, ebp
6:  xchg    eax, ebp
    // edx is -1 for a one, else 0. Its count goes up, the other one is halved.
    push    8
    pop     rcx
7:  pop     rsi
    lea     esi, [rsi + rdx * 2 + 2]
    inc     word ptr [rsi]
    xor     esi, 2
    shr     word ptr [rsi]
    adc     word ptr [rsi], 0
    loop    7b
    add     edx, edx
    rcl     byte ptr [rdi]
    jnc     next_bit
    inc     edi
    cmp     edi, offset second_end
    jne     next_byte
    // What is decoded from other bits than were coded ends with anything but this.
    cmp     dword ptr [rdi - 4], {end}
    jne     8f
    ret
8:  push    2
    pop     rdi
    mov     esi, offset refusal
    push    31
    pop     rdx
    push    1
    pop     rax
    syscall
    // As a shell ends where it has found what it cannot run.
    push    126
    pop     rdi
    push    60
    pop     rax
    syscall
refusal:
    .ascii  "paprsek: damaged, or no memory\n"
.popsection

// elkjs expects the scope of a worker; V8 alone has none.
(globalThis as unknown as { self: typeof globalThis }).self = globalThis;

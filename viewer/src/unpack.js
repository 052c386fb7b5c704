// Bytes from base64 text of a zlib stream.

function bytesOfBase64(text) {
    if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
    const letters = atob(text.trim());
    const bytes = new Uint8Array(letters.length);
    for (let n = 0; n < letters.length; ++n) bytes[n] = letters.charCodeAt(n);
    return bytes;
}

export async function unpack(text) {
    const stream = new Blob([bytesOfBase64(text)]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

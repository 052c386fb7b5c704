// Serves folders over HTTP, to pages of any origin and in parts (Range), as Neuroglancer needs.
import { createReadStream, statSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, normalize } from "node:path";

const kTypes = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm" };

/** `folders` by first part of the path: {"/model": FOLDER}. The promise is kept when the server listens. */
export function serve(folders) {
    const server = createServer((request, response) => {
        const path = normalize(decodeURIComponent(new URL(request.url, "http://localhost").pathname));
        const root = Object.keys(folders).find((name) => path.startsWith(`${name}/`));
        const file = root === undefined ? "" : join(folders[root], path.slice(root.length));
        const size = statSync(file, { throwIfNoEntry: false })?.isFile() ? statSync(file).size : -1;
        const head = {
            "Access-Control-Allow-Origin": "*",
            "Access-Control-Allow-Headers": "Range",
            "Access-Control-Expose-Headers": "Content-Range, Content-Length",
            "Content-Type": kTypes[extname(file)] ?? "application/octet-stream",
        };
        if (size < 0) return response.writeHead(request.method === "OPTIONS" ? 204 : 404, head).end();
        const range = /^bytes=(\d+)-(\d*)$/.exec(request.headers.range ?? "");
        const start = range ? Number(range[1]) : 0;
        const end = Math.min(range?.[2] ? Number(range[2]) : size - 1, size - 1);
        if (range && start > end) return response.writeHead(416, { ...head, "Content-Range": `bytes */${size}` }).end();
        head["Content-Length"] = end - start + 1;
        if (range) head["Content-Range"] = `bytes ${start}-${end}/${size}`;
        response.writeHead(range ? 206 : 200, head);
        if (request.method === "HEAD" || size === 0) return response.end();
        return createReadStream(file, { start, end }).pipe(response);
    });
    return new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve(server)));
}

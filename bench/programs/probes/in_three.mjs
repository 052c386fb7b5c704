// What three.js holds of a file; `npm ci` in viewer installs it.
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const home = join(dirname(fileURLToPath(import.meta.url)), '../../../viewer/node_modules/three');
const load = (path) => import(pathToFileURL(join(home, path)));
const { Box3, Mesh, Object3D, Vector3 } = await load('build/three.module.js');
const path = process.argv[2], bytes = readFileSync(path), text = () => bytes.toString('utf8');
const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
globalThis.self ??= globalThis;

async function open() {
    switch (path.split('.').pop()) {
        case 'obj': {
            const { OBJLoader } = await load('examples/jsm/loaders/OBJLoader.js');
            const { MTLLoader } = await load('examples/jsm/loaders/MTLLoader.js');
            const materials = new MTLLoader().parse(readFileSync(path.replace(/obj$/, 'mtl'), 'utf8'), '');
            return new OBJLoader().setMaterials(materials).parse(text());
        }
        case 'ply': {
            const { PLYLoader } = await load('examples/jsm/loaders/PLYLoader.js');
            return new Object3D().add(new Mesh(new PLYLoader().parse(buffer)));
        }
        case 'stl': {
            const { STLLoader } = await load('examples/jsm/loaders/STLLoader.js');
            return new Object3D().add(new Mesh(new STLLoader().parse(buffer)));
        }
        default: {
            const { GLTFLoader } = await load('examples/jsm/loaders/GLTFLoader.js');
            return new Promise((done, failed) => new GLTFLoader().parse(buffer, '', (file) => done(file.scene), failed));
        }
    }
}

const scene = await open();
scene.updateMatrixWorld(true);
const extent = new Box3().setFromObject(scene).getSize(new Vector3()).toArray();
const names = new Set(), colours = new Set();
let faces = 0, regions = 0;
scene.traverse((object) => {
    names.add(object.name);
    if (!object.isMesh) return;
    const { geometry } = object, colour = geometry.getAttribute('color');
    faces += (geometry.index ?? geometry.getAttribute('position')).count / 3;
    regions += Math.max(1, geometry.groups.length);
    for (const material of [object.material].flat()) {
        names.add(material.name);
        if (material.name) colours.add(material.color.getHexString());
    }
    for (let n = 0; colour && n < colour.count; ++n) colours.add(`${colour.getX(n)} ${colour.getY(n)} ${colour.getZ(n)}`);
});
console.log('FOUND ' + JSON.stringify({ extent, faces, regions, names: [...names].filter(Boolean), colours: colours.size }));
